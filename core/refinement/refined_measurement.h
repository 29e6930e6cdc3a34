#pragma once

#include "core/detection/post.h"
#include "core/geometry/camera.h"
#include "core/refinement/distance_errors.h"
#include "core/refinement/post_extent.h"
#include "core/refinement/refinement_parameters.h"
#include "core/refinement/silhouette_fit.h"

#include <array>

namespace goalmouth {

/// Puts what was fitted into the terms of a post.
///
/// Corners   where the two planes cut the first and last row of `extent`, lens distortion and all; those of
///           an edge that was not measured stay.
/// Width     between the edges, across their mean direction, as measure_post.
/// Distance  D = r / sin η, η half the angle between the planes: from the camera to the axis, square to it.
/// Bearing   −atan(x/z) of the point half-way between both edges in the picture's row half-way between the
///           corners' mean top and base rows: the axis of a leaning post has another bearing in each row.
///           With one edge alone the half angle is a guess, and its σ part of the bearing's.
/// Covariance  with C that of the silhouette step s (SilhouetteFit),
///               dD = −D·cot η · dη,   dβ = −cos²β · x'(row) · ½ (dx_l + dx_r)/ds · ds,
///           and, for what no row of the picture tells: outline_floor on each edge; a focal length wrong by
///           the share ε moves D by ε·D and β by −ε·sin β·cos β; a diameter wrong by ε moves D by ε·D.
/// Returns the same to first order in all errors; with one edge alone it has no distance.
PostEstimate set_measurement(Post& post, const SilhouetteFit& fit, const PostExtent& extent,
                             const std::array<bool, 2>& edges, const Intrinsics& camera, double radius,
                             const RefinementParameters& parameters);

}  // namespace goalmouth
