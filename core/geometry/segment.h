#pragma once

#include <algorithm>

#include <Eigen/Core>

namespace goalmouth {

/// Distance of a point to the segment from…to, in the plane or in space; a segment may be a point.
template <int dimensions>
double distance_to_segment(const Eigen::Matrix<double, dimensions, 1>& from,
                           const Eigen::Matrix<double, dimensions, 1>& to,
                           const Eigen::Matrix<double, dimensions, 1>& point) {
    const Eigen::Matrix<double, dimensions, 1> run = to - from;
    const double length = run.squaredNorm();
    const double share = length > 0.0 ? std::clamp((point - from).dot(run) / length, 0.0, 1.0) : 0.0;
    return (from + share * run - point).norm();
}

}  // namespace goalmouth
