#pragma once

#include "core/refinement/post_silhouette.h"

#include <Eigen/Core>

namespace goalmouth {

/// Where the errors of a post's distances and bearing come from. Each is known to first order in all of them,
/// so that what two cues have in common is not counted twice.
namespace distance_error {
inline constexpr int step = 0;             // 0…3: SilhouetteStep of the fit [rad]
inline constexpr int base_end = 4;         // slope of the base
inline constexpr int top_end = 5;          // slope of the top
inline constexpr int camera_height = 6;    // m
inline constexpr int focal = 7;            // the focal length's relative error; the same for all posts
inline constexpr int diameter = 8;         // the diameter's, likewise
inline constexpr int goal_height = 9;      // m, likewise
inline constexpr int outline_middle = 10;  // rad, of RefinementParameters::outline_floor on both edges
inline constexpr int outline_width = 11;   // rad, half
inline constexpr int count = 12;
}  // namespace distance_error

using DistanceErrors = Eigen::Matrix<double, distance_error::count, distance_error::count>;
using DistanceGradient = Eigen::Matrix<double, 1, distance_error::count>;

/// A post's distance and bearing, how they move with each error, and the errors' covariance.
struct PostEstimate {
    double distance = 0.0;  // m, from the camera to the axis
    double bearing = 0.0;   // rad, in frame C, + left
    DistanceGradient distance_change = DistanceGradient::Zero();
    DistanceGradient bearing_change = DistanceGradient::Zero();
    DistanceErrors errors = DistanceErrors::Zero();

    Eigen::Matrix2d covariance() const {
        Eigen::Matrix<double, 2, distance_error::count> change;
        change << distance_change, bearing_change;
        return change * errors * change.transpose();
    }
};

}  // namespace goalmouth
