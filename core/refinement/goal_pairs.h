#pragma once

#include "core/refinement/distance_errors.h"
#include "core/refinement/post_silhouette.h"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// A post of which both edges were measured.
struct GoalPairPost {
    PostSilhouette silhouette;
    PostEstimate estimate;
    /// Step of the fit per error of the measured vertical along the line of sight: what the fit keeps of it.
    Eigen::Vector4d kept_lean = Eigen::Vector4d::Zero();
};

/// What a goal's other post tells of one.
struct GoalPairResult {
    std::size_t post = 0;                                  // number in the list of posts
    Eigen::Vector2d estimate = Eigen::Vector2d::Zero();    // distance [m] and bearing [rad], with all cues
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of them
    double distance = 0.0,
           sigma = 0.0;  // m, what the pair alone would have had to say for that; sigma 0: hardly anything
};

/// Makes use of the known distance between the posts of a goal. With γ the angle between the posts' middle
/// planes, which meet in the vertical whatever the camera's attitude,
///
///     h(D₁, D₂, γ) = √(D₁² + D₂² − 2 D₁ D₂ cos γ) = goal width ± its sigma
///
/// updates distances and bearings of both as a measurement does in a Kalman filter, iterated as h is bent.
/// Errors of both posts that have one cause go into their joint covariance: focal length, diameter, goal
/// height, camera height, and the measured vertical (`vertical`: its covariance in frame C) as far as the
/// fits keep it.
///
/// Two posts are a goal's where h is within three sigmas of its width and neither has another such partner.
std::vector<GoalPairResult> pair_up(const std::vector<GoalPairPost>& posts, const Eigen::Matrix3d& vertical,
                                    double goal_width, double goal_error);

}  // namespace goalmouth
