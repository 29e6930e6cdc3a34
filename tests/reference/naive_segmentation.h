#pragma once

#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"
#include "core/segmentation/scan_lines.h"
#include "core/segmentation/segments.h"

namespace goalmouth {

/// What segment_frame() answers, by the plainest way there: each row walked across and each column walked
/// down, the table asked for every pixel, each change located as soon as its neighbours are known. Bit by bit
/// the same result.
Segments segment_frame_naively(YuyvView image, const ColourTable& table, const ScanLayout& layout);

/// The same into `out`, whose memory is used again.
void segment_frame_naively(YuyvView image, const ColourTable& table, const ScanLayout& layout, Segments& out);

}  // namespace goalmouth
