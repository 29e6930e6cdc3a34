#pragma once

#include "core/geometry/line.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace goalmouth {

/// Arrays of points have room for this many more behind the last one, which may be read and written over.
inline constexpr std::size_t room_behind_points = 16;

/// Samples of two points, one for each hypothesis: the first point, coarse as from coarse_points(), and the
/// way from there to the second.
struct LineSamples {
    static constexpr std::size_t most = 64;

    alignas(64) std::array<Eigen::Vector2f, most> point;
    alignas(64) std::array<Eigen::Vector2f, most> along;
    std::size_t count = 0;
};

/// The points in single precision, from the first one. Returns the largest of their coordinates by magnitude.
double coarse_points(const Eigen::Vector2d* points, std::size_t count, Eigen::Vector2f* coarse);

/// The distance [px] within which bound_support() finds all points that Line::distance() finds nearer than
/// `distance`, whatever rounding does: of points of which this is the first and the others reach as far from
/// there as coarse_points() says. Infinite where single precision does not suffice.
float coarse_distance(double distance, const Eigen::Vector2d& first, double reach);

/// For each sample the number of points nearer to the line through it than `distance` [px], finite, from
/// coarse_distance(): no fewer than Line::distance() finds. All points for a sample too short to tell. Room
/// for LineSamples::most in `support`. Returns the largest of these.
std::uint32_t bound_support(const LineSamples& samples, const Eigen::Vector2f* coarse, std::size_t count,
                            float distance, std::uint32_t* support);

/// Points nearer to the line than `distance`, exactly as Line::distance() decides it.
std::size_t count_inliers(const Eigen::Vector2d* points, std::size_t count, const Line& line,
                          double distance);

/// Moves those points, in their order, to `inliers` and the others together. Returns how many were moved.
std::size_t take_inliers(Eigen::Vector2d* points, std::size_t count, const Line& line, double distance,
                         Eigen::Vector2d* inliers);

}  // namespace goalmouth
