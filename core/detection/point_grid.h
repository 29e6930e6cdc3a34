#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

namespace goalmouth {

/// Columns of points have room for this many more behind the last one, which may be read and written over.
inline constexpr std::size_t room_behind_points = 16;

struct Box {
    Eigen::Vector2d least = Eigen::Vector2d::Zero();
    Eigen::Vector2d greatest = Eigen::Vector2d::Zero();
};

/// Copies points to columns. Returns the box around them, for no points any.
Box split_points(std::span<const Eigen::Vector2d> points, double* x, double* y);

/// Whole numbers for points in a box: (x, y) is at `scale` · ((x, y) − middle), of which 16 bits stand before
/// the point and are what distances are measured in, and 16 behind it, which keep the direction of a sample.
struct Grid {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    double scale = 0.0;     // 1/px; 0 where no such numbers would do
    std::int16_t near = 0;  // what is as far as this from a line in these numbers is not within the distance
};

struct GridPoint {
    std::int32_t x, y;  // 2^-16 of the grid
};

/// For points in this box, and finding all that Line::distance() finds nearer than `distance` [px].
Grid grid_for(const Box& box, double distance);
void place_on_grid(const Grid& grid, const double* x, const double* y, std::size_t count, GridPoint* points);

}  // namespace goalmouth
