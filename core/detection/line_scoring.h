#pragma once

#include "core/detection/point_grid.h"
#include "core/geometry/line.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace goalmouth {

/// Samples of two points, one for each hypothesis; so many are worked on at a time.
struct LineSamples {
    static constexpr std::size_t most = 64;

    alignas(64) std::array<GridPoint, most> first{};
    alignas(64) std::array<GridPoint, most> second{};
    std::size_t count = 0;
};

struct SupportBounds {
    std::uint32_t most = 0;  // the largest
    std::size_t first = 0;   // the first sample that has it
};

/// For each sample the number of points that may be nearer to the line through it than the distance that
/// `near` is for: no fewer than Line::distance() finds, and hardly more. All points for a sample too short to
/// tell. Room for LineSamples::most in `support`, and for as many as there are points in `rounded`, which is
/// written over.
SupportBounds bound_support(const LineSamples& samples, std::int16_t near, const GridPoint* points,
                            std::size_t count, GridPoint* rounded, std::uint32_t* support);

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
