#include "core/segmentation/segmentation.h"

#include "core/segmentation/transition.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// A segment that starts on column number `column` of the layout; its end is where the column's next one
/// starts.
struct ColumnStart {
    int column;
    std::int16_t y;
    Colour colour;
};

void append_row(YuyvView image, const ColourTable& table, int y, Segments& out) {
    ScanLine line{Orientation::horizontal, y, static_cast<int>(out.segments.size()), 0};
    for (int x = 0; x < image.width; ++x) {
        const Colour colour = table.at(image.at(x, y));
        if (x == 0 || colour != out.segments.back().colour) {
            out.segments.push_back({static_cast<std::int16_t>(x), 0, colour, 0.F});
            ++line.count;
        }
        out.segments.back().end = static_cast<std::int16_t>(x);
    }
    out.lines.push_back(line);
}

/// The segment starts of all columns, met in one walk down the frame's rows.
std::vector<ColumnStart> walk_columns(YuyvView image, const ColourTable& table,
                                      const std::vector<int>& columns) {
    std::vector<ColumnStart> starts;
    std::vector<Colour> current(columns.size(), Colour::unclassified);
    for (int y = 0; y < image.height; ++y) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const Colour colour = table.at(image.at(columns[i], y));
            if (y > 0 && colour == current[i]) continue;
            current[i] = colour;
            starts.push_back({static_cast<int>(i), static_cast<std::int16_t>(y), colour});
        }
    }
    return starts;
}

void append_columns(YuyvView image, const ColourTable& table, const std::vector<int>& columns,
                    Segments& out) {
    const std::vector<ColumnStart> starts = walk_columns(image, table, columns);
    const std::size_t first_line = out.lines.size();
    for (const int x : columns) out.lines.push_back({Orientation::vertical, x, 0, 0});
    for (const auto& start : starts) ++out.lines[first_line + static_cast<std::size_t>(start.column)].count;
    int next = static_cast<int>(out.segments.size());
    for (std::size_t i = first_line; i < out.lines.size(); ++i) {
        out.lines[i].first = next;
        next += out.lines[i].count;
    }

    out.segments.resize(static_cast<std::size_t>(next));
    std::vector<int> filled(columns.size(), 0);
    for (const auto& start : starts) {
        const auto column = static_cast<std::size_t>(start.column);
        const ScanLine& line = out.lines[first_line + column];
        const auto at = static_cast<std::size_t>(line.first + filled[column]);
        if (filled[column]++ > 0) out.segments[at - 1].end = static_cast<std::int16_t>(start.y - 1);
        out.segments[at] = {start.y, static_cast<std::int16_t>(image.height - 1), start.colour, 0.F};
    }
}

/// How far the window may reach into a segment from its boundary.
int reach(const Segment& segment) {
    constexpr int full = 3;
    if (segment.length() <= 2) return full;
    return std::min(full, (segment.length() + 1) / 2);
}

void locate_transitions(YuyvView image, Segments& out) {
    for (const ScanLine& line : out.lines) {
        for (int i = 0; i < line.count; ++i) {
            const auto at = static_cast<std::size_t>(line.first + i);
            Segment& segment = out.segments[at];
            const float nominal = static_cast<float>(segment.start) - 0.5F;
            segment.transition = nominal;
            if (i == 0) continue;
            const TransitionWindow window{reach(out.segments[at - 1]), reach(segment)};
            const float found =
                locate_transition(image, line.orientation, line.position, segment.start, window);
            const float offset = std::clamp(found - nominal, -1.27F, 1.27F);
            segment.transition = nominal + std::round(100.F * offset) / 100.F;
        }
    }
}

std::vector<int> inside(const std::vector<int>& positions, int size) {
    std::vector<int> kept;
    std::copy_if(positions.begin(), positions.end(), std::back_inserter(kept),
                 [size](int at) { return at >= 0 && at < size; });
    return kept;
}

}  // namespace

Segments segment_frame(YuyvView image, const ColourTable& table, const ScanLayout& layout) {
    Segments out;
    out.width = image.width;
    out.height = image.height;
    if (image.empty()) return out;
    for (const int y : inside(layout.rows, image.height)) append_row(image, table, y, out);
    append_columns(image, table, inside(layout.columns, image.width), out);
    locate_transitions(image, out);
    return out;
}

}  // namespace goalmouth
