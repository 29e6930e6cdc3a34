#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_summary.h"

#include <string>
#include <vector>

namespace goalmouth {

/// In words, a paragraph each: what was measured; how the RMSE of RANSAC stands to that of the histogram, in
/// each scene and in the paper (where both were run); where RANSAC, else the first detector, does worst.
std::vector<std::string> paper_headline(const PaperResult& result, const RecordTable& table);

/// "a", "a and b", "a, b and c".
std::string enumeration(const std::vector<std::string>& words);

}  // namespace goalmouth
