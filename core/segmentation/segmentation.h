#pragma once

#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"
#include "core/segmentation/scan_lines.h"
#include "core/segmentation/segments.h"

namespace goalmouth {

/// Labels the pixels on the layout's scan-lines by the table and cuts each line where the class changes
/// (paper, section 2, step 3). Rows first, then columns, in the layout's order. Nothing is smoothed: what to
/// make of one-pixel segments is for extraction to say.
///
/// The frame is walked row by row for both orientations, because columns would touch a cache line for every
/// pixel. Sub-pixel transitions: transition.h; where a segment of three pixels or more ends inside the
/// window, the window ends in its middle, while shorter ones count as part of the blur between their
/// neighbours. Offsets from start − 0.5 are limited to ±1.27 px and rounded to 1/100 px, what a segments_t
/// holds.
///
/// Lines of the layout outside the image are left out.
Segments segment_frame(YuyvView image, const ColourTable& table, const ScanLayout& layout);

}  // namespace goalmouth
