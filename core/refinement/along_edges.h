#pragma once

#include "core/geometry/camera.h"
#include "core/refinement/coarse_edges.h"
#include "core/refinement/crossing_curve.h"

#include <algorithm>
#include <cstddef>

namespace goalmouth {

/// A row in which a coarse edge crosses the picture.
struct EdgeRow {
    std::size_t side = 0;  // 0 left, 1 right
    double share = 0.0;    // of the outline's rows that lie above
    int y = 0;
    double edge = 0.0;    // px
    double inside = 0.0;  // px to the post's middle

    double outwards() const { return side == 0 ? -1.0 : 1.0; }
};

/// Visits rows of both edges, spread evenly over the outline, `most_rows` of each at most.
template <class Visit>
void along_edges(const RoughOutline& outline, const Intrinsics& camera, const CoarseEdgeFinder::Edges& edges,
                 int most_rows, const Visit& visit) {
    CrossingCurve curve;
    const int rows = outline.last_row - outline.first_row + 1;
    const int lines = std::min(most_rows, rows);
    for (std::size_t side = 0; side < 2; ++side) {
        if (!edges[side]) continue;
        const double guess = side == 0 ? outline.left(outline.first_row) : outline.right(outline.first_row);
        curve.follow(camera, edges[side]->plane, guess, outline.first_row, outline.last_row);
        for (int i = 0; i < lines; ++i) {
            EdgeRow row;
            row.side = side;
            row.share = static_cast<double>(i) / lines;
            row.y = outline.first_row + static_cast<int>((2LL * i + 1) * rows / (2LL * lines));
            row.edge = curve.at(row.y).x;
            row.inside = 0.5 * (outline.right(row.y) - outline.left(row.y));
            if (row.edge > 0.0 && row.edge < camera.width) visit(row);
        }
    }
}

}  // namespace goalmouth
