#pragma once

#include "tools/evaluate/paper_run.h"

#include <string>

namespace goalmouth {

/// "2/4": part 2 of 4. Throws ConfigurationError that begins with `option` for anything but 1 ≤ I ≤ N.
Shard parse_shard(const std::string& text, const std::string& option = "shard");

/// Back to "2/4".
std::string shard_text(const Shard& shard);

}  // namespace goalmouth
