#pragma once

#include "core/geometry/camera.h"
#include "core/refinement/pixel_rays.h"
#include "core/refinement/post_silhouette.h"

#include <optional>

namespace goalmouth {

/// Slope along a post's axis, against the square to it, at which the line of sight meets it in a row.
double slope_in_row(const PostSilhouette& post, const Intrinsics& camera, PixelRays& rays, double row);

/// The row [px] of the line of sight at a slope; nothing where none within reach of a picture has it.
std::optional<double> row_of_slope(const PostSilhouette& post, const Intrinsics& camera, double slope);

}  // namespace goalmouth
