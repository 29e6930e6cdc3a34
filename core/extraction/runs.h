#pragma once

#include "core/extraction/candidate_parameters.h"
#include "core/extraction/candidates.h"
#include "core/segmentation/segments.h"

#include <optional>
#include <vector>

namespace goalmouth {

/// Segments of the post's colour on one scan-line with the small gaps between them bridged.
struct Run {
    CandidateSegment segment;
    std::optional<float> entry;  // px along the line, transition into it; nothing at the image border
    std::optional<float> exit;
    int row = 0;  // number of the horizontal scan-line, from the top
};

/// Appends the runs of a line that are neither too short nor too long, in order along it.
void append_runs(const Segments& segments, const ScanLine& line, int row,
                 const CandidateParameters& parameters, std::vector<Run>& runs);

}  // namespace goalmouth
