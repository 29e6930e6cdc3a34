#pragma once

#include "core/imaging/colour_table.h"
#include "tests/bench/contender.h"
#include "tests/bench/frames.h"

#include <cstdint>

namespace goalmouth::bench {

// Our stages with their standard parameters (config/modules), on scan-lines every `spacing` px both ways. All
// refer to the frames they are given.

Contender our_segments(const FrameSet& frames, const ColourTable& table, int spacing);

/// The same by edges, without a colour table: what segmentation_edges does to a frame.
Contender edge_segments(const FrameSet& frames, int spacing);

/// Frame to posts, as the graph's processes do it. Its parts are the border, the candidates and RANSAC.
Contender our_chain(const FrameSet& frames, const ColourTable& table, int spacing, std::uint64_t seed);

/// The same segments as ours, by the plainest way there.
Contender naive_segments(const FrameSet& frames, const ColourTable& table, int spacing);

}  // namespace goalmouth::bench
