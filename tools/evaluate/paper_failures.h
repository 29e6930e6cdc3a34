#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_setup.h"
#include "tools/evaluate/report/html_page.h"

#include <cstddef>
#include <vector>

namespace goalmouth {

/// The frames in which a detector did worst in a scene: the largest errors of distance, missed posts (the
/// nearest first), the most false posts; as places in result.records, each once.
std::vector<std::size_t> worst_frames(const PaperResult& result, std::size_t detector, std::size_t scene);

/// Those frames, rendered and detected once more from their numbers, with what is true and what was found
/// drawn in.
std::vector<PagePicture> failure_pictures(const PaperResult& result, const PaperSetup& setup,
                                          std::size_t detector, std::size_t scene);

}  // namespace goalmouth
