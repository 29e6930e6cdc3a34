#pragma once

#include "tools/evaluate/paper_result.h"

#include <string>
#include <vector>

namespace goalmouth {

/// The whole from its parts, the same as if it had been run at once but for the command. Throws
/// ConfigurationError, naming files, where they are not parts of one whole, hold a frame twice or, unless
/// `partial`, do not hold all.
PaperResult merge_results(const std::vector<std::string>& files, bool partial);

}  // namespace goalmouth
