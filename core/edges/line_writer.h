#pragma once

#include "core/segmentation/segments.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace goalmouth {

/// Appends a line's segments one by one; no two neighbours are of one colour.
class LineWriter {
  public:
    LineWriter(Segments& out, Orientation orientation, int position) : out_(out) {
        line_ = {orientation, position, static_cast<int>(out.segments.size()), 0};
    }
    /// From pixel `start` on the line is of that colour; `transition` as Segment has it. The first change is
    /// that at 0. One at the latest change, or before it, takes its place.
    void change(int start, Colour colour, float transition) {
        if (line_.count > 0 && start <= out_.segments.back().start) {
            Segment& last = out_.segments.back();
            last.colour = colour;
            if (line_.count > 1 && out_.segments[out_.segments.size() - 2].colour == colour) {
                out_.segments.pop_back();
                --line_.count;
            }
            return;
        }
        if (line_.count > 0) {
            Segment& last = out_.segments.back();
            if (last.colour == colour) return;
            last.end = static_cast<std::int16_t>(start - 1);
        }
        // What a segments_t holds: hundredths of a pixel, no more than 127 of them.
        const float nominal = static_cast<float>(start) - 0.5F;
        const float offset = std::clamp(std::round(100.F * (transition - nominal)), -127.F, 127.F) / 100.F;
        out_.segments.push_back({static_cast<std::int16_t>(start), 0, colour, nominal + offset});
        ++line_.count;
    }
    void change(int start, Colour colour) { change(start, colour, static_cast<float>(start) - 0.5F); }
    /// The line is `length` px long.
    void end(int length) {
        out_.segments.back().end = static_cast<std::int16_t>(length - 1);
        out_.lines.push_back(line_);
    }

  private:
    Segments& out_;
    ScanLine line_;
};

}  // namespace goalmouth
