#include "core/refinement/axis_slope.h"

#include <cmath>

namespace goalmouth {

double slope_in_row(const PostSilhouette& post, const Intrinsics& camera, PixelRays& rays, double row) {
    const RowRay ray = rays.crossing(post.right, camera.cx, row);
    return ray.ray.dot(post.up) / ray.ray.dot(post.ahead);
}

std::optional<double> row_of_slope(const PostSilhouette& post, const Intrinsics& camera, double slope) {
    const auto pixel = project(camera, post.ahead + slope * post.up);
    constexpr double far = 1e6;  // px, beyond every picture
    if (!pixel || !(std::abs(pixel->y()) < far)) return std::nullopt;
    return pixel->y();
}

}  // namespace goalmouth
