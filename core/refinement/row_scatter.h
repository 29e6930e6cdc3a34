#pragma once

#include "core/refinement/edge_rows.h"

#include <array>

namespace goalmouth {

/// What the rows of a fit say of it, once it has settled.
struct RowScatter {
    bool enough = false;       // rows to say anything
    double variance = 1.0;     // of the rows' offsets, against what their noise and edge_roughness explain
    double correlation = 1.0;  // rows that say as much as one on its own: neighbours resemble each other
    std::array<int, 2> looked_at{};  // rows of either side where the background differs
    std::array<int, 2> agreeing{};   // of these, which count for half or more
};

/// How the offsets of the rows that count scatter about the fit.
RowScatter row_scatter(const std::array<EdgeRows, 2>& rows);

}  // namespace goalmouth
