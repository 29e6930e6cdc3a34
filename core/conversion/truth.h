#pragma once

#include "core/simulation/truth.h"

#include <cstdint>

#include <goalmouth/truth_t.hpp>

namespace goalmouth {

truth_t to_message(const Truth& truth, std::int64_t utime, std::int64_t seq);
Truth from_message(const truth_t& message);

}  // namespace goalmouth
