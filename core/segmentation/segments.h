#pragma once

#include "core/imaging/colour.h"

#include <cstdint>
#include <vector>

namespace goalmouth {

enum class Orientation : std::int8_t { horizontal = 0, vertical = 1 };

/// One scan-line: a row (horizontal) or a column (vertical) of the image.
struct ScanLine {
    Orientation orientation = Orientation::horizontal;
    int position = 0;  // px: y of a row, x of a column
    int first = 0;     // index of its first segment
    int count = 0;  // its segments stand at first … first + count − 1, contiguous and in order along the line
};

/// A run of pixels of one class on a scan-line (paper, section 2, step 3).
struct Segment {
    std::int16_t start = 0;  // px along the line, first pixel
    std::int16_t end = 0;    // px along the line, last pixel
    Colour colour = Colour::unclassified;
    float transition = 0.F;  // px along the line: sub-pixel position of the change into this segment; start −
                             // 0.5 at the image border

    int length() const { return end - start + 1; }
    float centre() const { return 0.5F * static_cast<float>(start + end); }
};

/// All segments of a frame. A line's segments cover it from end to end.
struct Segments {
    int width = 0;   // px of the image
    int height = 0;  // px of the image
    std::vector<ScanLine> lines;
    std::vector<Segment> segments;

    void clear() {
        lines.clear();
        segments.clear();
    }
};

}  // namespace goalmouth
