#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_setup.h"
#include "tools/evaluate/report/html_page.h"

#include <cstddef>
#include <string>
#include <vector>

namespace goalmouth {

/// A frame in which a detector did badly.
struct WorstFrame {
    enum class Kind { distance, missed, false_posts };
    std::size_t record = 0;  // place in PaperResult::records
    Kind kind = Kind::distance;
    std::size_t rank = 0;  // among those of its kind, from 0
};

/// The frames in which a detector did worst in a scene: the two largest errors of distance, two with missed
/// posts (the nearest first), the two with most false posts; each frame once.
std::vector<WorstFrame> worst_frames(const PaperResult& result, std::size_t detector, std::size_t scene);

/// "600 cm, 20°: 0 of 2 found, 1 false, distance 4.97 m short"; where nothing was missed and nothing false,
/// what else is bad about it stands before.
std::string failure_caption(const FrameRecord& frame, const DetectorRecord& record, const WorstFrame& chosen);

/// Those frames, rendered and detected once more from their numbers, with what is true and what was found
/// drawn in.
std::vector<PagePicture> failure_pictures(const PaperResult& result, const PaperSetup& setup,
                                          std::size_t detector, std::size_t scene);

}  // namespace goalmouth
