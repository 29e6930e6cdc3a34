#pragma once

#include "core/edges/appearance.h"
#include "core/edges/upright_line.h"

#include <optional>
#include <vector>

namespace goalmouth {

/// A row on which a strip's surface is seen [px].
struct StripRow {
    int y = 0;
    std::optional<float> left, right;  // its edges, each where it shows
};

/// An upright strip of one surface between two straight edges: what may be a post.
struct UprightStrip {
    UprightLine left, right;
    std::vector<StripRow> rows;  // from top to bottom; the first and the last show an edge
    Appearance inside;           // mean
    int both = 0;                // rows that show both edges
    double contrast =
        0.0;  // grey levels: how unlike it its surroundings look, the more alike side, mean over those rows

    double top() const { return rows.front().y; }
    double base() const { return rows.back().y; }
    double width_at(double y) const { return right.at(y) - left.at(y); }
    double middle_at(double y) const { return 0.5 * (left.at(y) + right.at(y)); }
    double length() const { return base() - top(); }
};

}  // namespace goalmouth
