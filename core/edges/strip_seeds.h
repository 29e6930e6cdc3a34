#pragma once

#include "core/edges/edge_chains.h"
#include "core/edges/edge_parameters.h"
#include "core/edges/frame_edges.h"

#include <span>
#include <vector>

namespace goalmouth {

/// A left and a right chain with one surface between them.
struct StripSeed {
    UprightLine left, right;
    int first_row = 0, last_row = 0;  // numbers of scan-lines
    Appearance inside;                // mean
    double contrast = 0.0;            // grey levels, as UprightStrip has it
    int rows = 0;                     // that show both edges
};

/// Pairs of chains that may be a strip: as wide and as parallel as posts are, seen together on most of at
/// least `least_rows` rows, in most of which the surfaces just inside the two edges look alike and nothing
/// between them stands out as they do. From the most to the least distinct. `width`: px of the picture.
void find_strip_seeds(const FrameEdges& frame, std::span<const EdgeChain> left,
                      std::span<const EdgeChain> right, const StripParameters& parameters,
                      float chroma_weight, double straightness, int width, std::vector<StripSeed>& seeds);

}  // namespace goalmouth
