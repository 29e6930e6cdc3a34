#include "tests/reference/naive_segmentation.h"

#include "core/segmentation/transition.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// How far a transition's window may reach into a segment: to its middle, or past it where it is no longer
/// than a blur.
int reach(int length) {
    return length <= 2 ? 3 : std::min(3, (length + 1) / 2);
}

void append_line(YuyvView image, const ColourTable& table, Orientation orientation, int position,
                 Segments& out) {
    const bool along_row = orientation == Orientation::horizontal;
    const int length = along_row ? image.width : image.height;
    const std::size_t first = out.segments.size();
    for (int i = 0; i < length; ++i) {
        const Colour colour = table.at(along_row ? image.at(i, position) : image.at(position, i));
        const auto at = static_cast<std::int16_t>(i);
        if (i == 0 || colour != out.segments.back().colour)
            out.segments.push_back({at, at, colour, static_cast<float>(i) - 0.5F});
        out.segments.back().end = at;
    }
    for (std::size_t i = first + 1; i < out.segments.size(); ++i) {
        Segment& segment = out.segments[i];
        const TransitionWindow window{reach(out.segments[i - 1].length()), reach(segment.length())};
        const float nominal = segment.transition;
        const float found = locate_transition(image, orientation, position, segment.start, window);
        const float offset = std::clamp(found - nominal, -1.27F, 1.27F);
        segment.transition = nominal + std::round(100.F * offset) / 100.F;
    }
    out.lines.push_back(
        {orientation, position, static_cast<int>(first), static_cast<int>(out.segments.size() - first)});
}

}  // namespace

Segments segment_frame_naively(YuyvView image, const ColourTable& table, const ScanLayout& layout) {
    Segments out;
    segment_frame_naively(image, table, layout, out);
    return out;
}

void segment_frame_naively(YuyvView image, const ColourTable& table, const ScanLayout& layout,
                           Segments& out) {
    out.lines.clear();
    out.segments.clear();
    out.width = image.width;
    out.height = image.height;
    if (image.empty()) return;
    for (const int y : layout.rows)
        if (y >= 0 && y < image.height) append_line(image, table, Orientation::horizontal, y, out);
    for (const int x : layout.columns)
        if (x >= 0 && x < image.width) append_line(image, table, Orientation::vertical, x, out);
}

}  // namespace goalmouth
