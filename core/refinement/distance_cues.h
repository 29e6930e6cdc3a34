#pragma once

#include "core/field/field.h"
#include "core/refinement/distance_errors.h"
#include "core/refinement/post_end.h"
#include "core/refinement/post_silhouette.h"
#include "core/refinement/refined_post.h"
#include "core/refinement/refinement_parameters.h"

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// The camera above the ground, as far as the pose tells.
struct CameraStance {
    double height = 0.0;                                // m
    double variance = 0.0;                              // m²
    Eigen::Vector3d with_up = Eigen::Vector3d::Zero();  // m, covariance with the vertical in frame C
};

/// What is known of a post beside the distance that its width tells.
struct PostEnds {
    std::optional<PostEnd> base, top;
};

/// All distances of one post, and what they are together.
struct CombinedDistance {
    std::vector<DistanceCue> cues;  // each on its own, the width's first
    PostEstimate estimate;
};

/// Distances of a post from its ends, and together with that from its width. With r the post's radius, t_b
/// and t_t the slopes of base and top against level in the post's middle plane, h the camera's height and H
/// the height of the goal's upper edge,
///
///     base      D = r + h/(−t_b)
///     crossbar  D = (H + r (±t_t − t_b)) / (t_t − t_b),  + for a top above the camera, − for one below,
///
/// both from the camera to the axis, along the ground. Level is what the fit of the silhouette says of the
/// vertical. An error of lean δ moves a slope by −(1 + t²) δ, so it moves the base's distance much and that
/// of the height hardly.
///
/// Cues have errors in common: vertical, focal length, diameter, base point. With distances y, J their
/// gradient by all errors and S the errors' covariance, Σ = J S Jᵀ, and distance and bearing are the
/// generalised least squares of (y, β) by Σ: the best that is linear in them. A cue that is more than
/// `cue_gate` sigmas off the width's distance is told but not combined: of goals the height in the field
/// file is more often wrong than an edge.
CombinedDistance combine_distances(const PostEstimate& width, const PostSilhouette& post,
                                   const PostEnds& ends, const std::optional<CameraStance>& camera,
                                   double lean_sigma, const Field& field,
                                   const RefinementParameters& parameters);

}  // namespace goalmouth
