#pragma once

#include "core/edges/row_edges.h"

#include <cstddef>
#include <span>
#include <vector>

namespace goalmouth {

/// The edges on all horizontal scan-lines of a frame.
struct FrameEdges {
    std::vector<int> rows;           // px, y of the scan-lines, ascending
    std::vector<RowEdge> edges;      // row by row, each from left to right
    std::vector<std::size_t> first;  // number of each row's first edge; one more at the end

    double y(int row) const { return rows[static_cast<std::size_t>(row)]; }
    std::span<const RowEdge> of(std::size_t row) const {
        return std::span(edges).subspan(first[row], first[row + 1] - first[row]);
    }
};

}  // namespace goalmouth
