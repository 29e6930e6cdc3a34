#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Upper convex hull of image points by Andrew's monotone chain (A. M. Andrew, 1979): the chain from the
/// leftmost to the rightmost point that no point lies above. "Above" is towards smaller y, because image y
/// runs down.
///
/// Vertices from left to right, x strictly increasing; points on a hull edge are no vertices. Of points with
/// one x only the highest counts, so the hull of a vertical set is one point; the hull of nothing is empty.
std::vector<Eigen::Vector2d> upper_hull(std::vector<Eigen::Vector2d> points);

/// The same into memory that is there already; sorts the points.
void upper_hull(std::span<Eigen::Vector2d> points, std::vector<Eigen::Vector2d>& hull);

/// y at column x of a chain of points from left to right, such as a hull; beyond its ends, that of the nearer
/// end. Requires a point.
double chain_y_at(std::span<const Eigen::Vector2d> chain, double x);

}  // namespace goalmouth
