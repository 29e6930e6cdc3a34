#pragma once

#include <nlohmann/json_fwd.hpp>

namespace goalmouth {

/// In words, by the name of the figure: what each number of a result is.
nlohmann::ordered_json paper_rule();

}  // namespace goalmouth
