#include "core/refinement/refined_measurement.h"

#include "core/refinement/pixel_rays.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr double unknown_distance_sigma = 10.0;  // m, as measure_post

double square(double x) {
    return x * x;
}

/// Change of a plane's crossing with a row per step [px].
SilhouetteStep crossing_change(const PostSilhouette& post, OutlineSide side, const RowRay& ray) {
    const Eigen::Vector3d plane = post.plane(side);
    return -(post.plane_change(side).transpose() * ray.ray) / plane.dot(ray.slope);
}

}  // namespace

PostEstimate set_measurement(Post& post, const SilhouetteFit& fit, const PostExtent& extent,
                             const std::array<bool, 2>& edges, const Intrinsics& camera, double radius,
                             const RefinementParameters& parameters) {
    const Eigen::Vector3d left_plane = fit.post.plane(OutlineSide::left);
    const Eigen::Vector3d right_plane = fit.post.plane(OutlineSide::right);
    const auto top = static_cast<double>(extent.first_row);
    const auto base = static_cast<double>(extent.last_row);
    PixelRays rays(camera);
    if (edges[0]) {
        post.left_top = {rays.crossing(left_plane, post.left_top.x(), top).x, top};
        post.left_base = {rays.crossing(left_plane, post.left_top.x(), base).x, base};
    }
    if (edges[1]) {
        post.right_top = {rays.crossing(right_plane, post.right_top.x(), top).x, top};
        post.right_base = {rays.crossing(right_plane, post.right_top.x(), base).x, base};
    }
    const Eigen::Vector2d along =
        (post.left_base - post.left_top).normalized() + (post.right_base - post.right_top).normalized();
    const Eigen::Vector2d apart =
        0.5 * (post.right_top + post.right_base) - 0.5 * (post.left_top + post.left_base);
    const Eigen::Vector2d direction = along.normalized();
    post.width_px = std::max(1e-3, std::abs(direction.x() * apart.y() - direction.y() * apart.x()));

    const double row = 0.25 * (post.left_top + post.left_base + post.right_top + post.right_base).y();
    const double near = 0.25 * (post.left_top + post.left_base + post.right_top + post.right_base).x();
    const RowRay left = rays.crossing(left_plane, near, row);
    const RowRay right = rays.crossing(right_plane, left.x, row);
    const RowRay middle = rays.at(0.5 * (left.x + right.x), row);
    const double u = middle.ray.x();
    post.bearing_rad = -std::atan(u);
    const double per_px = middle.slope.x() / (1.0 + u * u);  // rad
    const SilhouetteStep bearing_change = -per_px * 0.5 *
                                          (crossing_change(fit.post, OutlineSide::left, left) +
                                           crossing_change(fit.post, OutlineSide::right, right));

    PostEstimate estimate;
    estimate.bearing = post.bearing_rad;
    using namespace distance_error;
    estimate.errors.block<4, 4>(step, step) = fit.covariance;
    estimate.errors(outline_middle, outline_middle) = estimate.errors(outline_width, outline_width) =
        square(parameters.outline_floor * per_px) / 2.0;
    estimate.errors(focal, focal) = square(parameters.focal_error);
    estimate.errors(diameter, diameter) = square(parameters.diameter_error);
    estimate.bearing_change.segment<4>(step) = bearing_change.transpose();
    estimate.bearing_change[outline_middle] = 1.0;
    estimate.bearing_change[focal] = -std::sin(post.bearing_rad) * std::cos(post.bearing_rad);
    if (!edges[0] || !edges[1]) {
        post.flags |= post_flag::no_distance;
        post.distance_m = 0.0;
        post.covariance = estimate.covariance();
        post.covariance(0, 0) = square(unknown_distance_sigma);
        return estimate;
    }
    post.flags &= ~post_flag::no_distance;
    const double distance = radius / std::sin(fit.post.half_angle);
    const double per_half_angle = -distance / std::tan(fit.post.half_angle);
    post.distance_m = estimate.distance = distance;
    estimate.distance_change[step + silhouette_part::half_angle] = per_half_angle;
    estimate.distance_change[outline_width] = per_half_angle;
    estimate.distance_change[focal] = distance;
    estimate.distance_change[diameter] = distance;
    post.covariance = estimate.covariance();
    return estimate;
}

}  // namespace goalmouth
