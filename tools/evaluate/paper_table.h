#pragma once

#include "tools/evaluate/paper_result.h"

#include <string>

namespace goalmouth {

/// For a terminal: by detector, scene and tilt what was detected and how far off its distances were, with the
/// paper's figures and the distances at which it did worst beside.
std::string paper_table(const PaperResult& result);

}  // namespace goalmouth
