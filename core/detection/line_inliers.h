#pragma once

#include "core/detection/point_grid.h"
#include "core/geometry/line.h"

#include <cstddef>

namespace goalmouth {

/// Points nearer to the line than `distance`, exactly as Line::distance() decides it.
std::size_t count_inliers(const double* x, const double* y, std::size_t count, const Line& line,
                          double distance);

/// Columns of points with their places on a grid.
struct PointTable {
    double* x;
    double* y;
    GridPoint* grid;
};

/// Moves those points, in their order, to `inlier_x` and `inlier_y` and the others together. Returns how many
/// were moved.
std::size_t take_inliers(const PointTable& points, std::size_t count, const Line& line, double distance,
                         double* inlier_x, double* inlier_y);

}  // namespace goalmouth
