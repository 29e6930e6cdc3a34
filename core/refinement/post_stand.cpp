#include "core/refinement/post_stand.h"

#include "core/refinement/axis_slope.h"

#include <cmath>

namespace goalmouth {
std::optional<double> PostStand::crossbar_row(double wider) const {
    if (!height && !foot) return std::nullopt;
    const double so_far = distance / wider;
    const double from = height ? -*height / so_far : *foot;
    return row_of_slope(post, camera, from + (goal_height - 3.0 * radius) / so_far);
}

bool PostStand::reaches(double wider) const {
    if (!top || (!height && !foot)) return false;
    constexpr double sure = 2.0, roughly = 0.05;
    const double so_far = distance / wider;
    const double from = height ? -*height / so_far : *foot;
    const double length = (goal_height + radius) / so_far;
    return std::abs(*top - from - length) < sure * (height ? sigma : 0.0) + roughly * length;
}

PostStand post_stand(const PostSilhouette& post, const PostExtent& extent,
                     const std::optional<CameraStance>& stance, double lean_sigma, const Intrinsics& camera,
                     const Field& field) {
    PostStand stand;
    stand.camera = camera;
    stand.post = post;
    stand.radius = 0.5 * field.post_diameter;
    stand.distance = stand.radius / std::sin(post.half_angle);
    stand.goal_height = field.goal_height;
    PixelRays rays(camera);
    const double seen = slope_in_row(post, camera, rays, extent.last_row);
    if (extent.top_seen) stand.top = slope_in_row(post, camera, rays, extent.first_row);
    if (extent.base_seen) stand.foot = seen;
    if (!stance) return stand;
    stand.height = stance->height;
    const double below = -stance->height / stand.distance;
    stand.sigma =
        std::hypot(lean_sigma * (1.0 + below * below), std::sqrt(stance->variance) / stand.distance);
    constexpr double sure = 4.0, roughly = 0.1;  // sigmas; of the slope: what the sigmas leave out
    // The front of its foot is nearer than its axis by the radius.
    const double lowest = below * stand.distance / (stand.distance - stand.radius);
    const double highest = (stand.goal_height + stand.radius - stance->height) / stand.distance;
    stand.overtops = stand.top && *stand.top > highest + roughly * (highest - below) + sure * stand.sigma;
    stand.sinks = seen < lowest * (1.0 + roughly) - sure * stand.sigma;
    return stand;
}

}  // namespace goalmouth
