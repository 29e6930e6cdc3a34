#pragma once

#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"
#include "core/segmentation/column_scan.h"
#include "core/segmentation/pixel_labels.h"
#include "core/segmentation/row_scan.h"
#include "core/segmentation/scan_lines.h"
#include "core/segmentation/segments.h"

#include <vector>

namespace goalmouth {

/// Labels the pixels on the layout's scan-lines by the table and cuts each line where the class changes
/// (paper, section 2, step 3). Rows first, then columns, in the layout's order. Nothing is smoothed: what to
/// make of one-pixel segments is for extraction to say.
///
/// Sub-pixel transitions: transition.h; where a segment of three pixels or more ends inside the window, the
/// window ends in its middle, while shorter ones count as part of the blur between their neighbours. Offsets
/// from start − 0.5 are limited to ±1.27 px and rounded to 1/100 px, what a segments_t holds.
///
/// Lines of the layout outside the image are left out.
///
/// The frame is walked once, in bands of a few rows that stay in cache: columns, rows, and the pixels around
/// what changed there. Vector instructions are those of the machine it runs on; the result is the same on
/// each, bit by bit.
class Segmenter {
  public:
    /// Keeps a copy of the table.
    explicit Segmenter(const ColourTable& table);

    /// The image's segments, valid until the next call. Asks the heap for nothing once it has seen a frame as
    /// rich in segments.
    const Segments& segment(YuyvView image, const ScanLayout& layout);

  private:
    LabelTable table_;
    RowScan rows_;
    ColumnScan columns_;
    std::vector<int> inside_;  // px, the layout's columns inside the image
    Segments segments_;
};

/// One frame: a Segmenter used once.
Segments segment_frame(YuyvView image, const ColourTable& table, const ScanLayout& layout);

}  // namespace goalmouth
