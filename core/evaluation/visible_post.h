#pragma once

#include "core/evaluation/edge_path.h"
#include "core/evaluation/reference_post.h"
#include "core/geometry/camera.h"
#include "core/simulation/truth.h"

#include <array>
#include <optional>

namespace goalmouth {

/// Which true posts an evaluation asks for.
struct CountingRule {
    double least_inside = 0.5;    // share of its rows in which both edges lie within the picture's width
    double largest_hidden = 0.4;  // share of what lies inside the picture
};

/// What an ideal detector would outline of a true post, whose left and right edge in the picture are given:
/// each becomes the straight line between its ends, and those lie where the post enters and leaves the
/// picture, so that no row is left without any of it. An edge may still lie beside the picture where the
/// other one is inside. Nothing where no part of the post is in the picture.
///
/// It counts where in at least `least_inside` of its rows between the picture's top and bottom both edges lie
/// between the left and the right border, and of its part inside the picture (TruePost::inside) no more than
/// `largest_hidden` is hidden.
std::optional<ReferencePost> visible_outline(const TruePost& post, const std::array<EdgePath, 2>& edges,
                                             const Intrinsics& camera, const CountingRule& rule);

/// Bearing −atan(x/z) [rad, + left] of the outline's middle line in a row of the picture.
double bearing_in_row(const ReferencePost& outline, const Intrinsics& camera, double row);

}  // namespace goalmouth
