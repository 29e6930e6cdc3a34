#include "core/detection/measurement.h"

#include "core/detection/pairing.h"
#include "core/geometry/line.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

LineSegment edge(const Eigen::Vector2d& top, const Eigen::Vector2d& base) {
    const auto line = line_through(top, base);
    return {line ? *line : line_with_normal({1.0, 0.0}, top), top, base};
}

std::uint32_t cut_flags(const Post& post, const Intrinsics& camera, double margin) {
    std::uint32_t flags = 0;
    if (std::min(post.left_top.y(), post.right_top.y()) < margin) flags |= post_flag::cut_top;
    if (std::max(post.left_base.y(), post.right_base.y()) > camera.height - 1 - margin)
        flags |= post_flag::cut_bottom;
    if (std::min(post.left_top.x(), post.left_base.x()) < margin) flags |= post_flag::cut_left;
    if (std::max(post.right_top.x(), post.right_base.x()) > camera.width - 1 - margin)
        flags |= post_flag::cut_right;
    return flags;
}

}  // namespace

double pixel_angular_width(const Intrinsics& camera, const Eigen::Vector2d& axis) {
    const Eigen::Vector2d along = axis.normalized();
    return 1.0 / std::hypot(along.y() / camera.fx, along.x() / camera.fy);
}

void measure_post(Post& post, const Intrinsics& camera, double diameter, double left_sigma,
                  double right_sigma, const MeasurementParameters& parameters) {
    constexpr double unknown_distance_sigma = 10.0;  // m
    constexpr double least_width = 1e-3;             // px
    post.flags |= cut_flags(post, camera, parameters.border_margin);
    if (post.has(post_flag::left_edge_missing | post_flag::right_edge_missing | post_flag::fills_image)) {
        post.flags |= post_flag::no_distance;
    }

    const LineSegment left = edge(post.left_top, post.left_base);
    const LineSegment right = edge(post.right_top, post.right_base);
    post.width_px = std::max(std::abs(width_across(left, right)), least_width);
    const Eigen::Vector2d middle = 0.5 * (left.middle() + right.middle());
    const double slope = normalised_from_pixel(camera, middle).x();
    post.bearing_rad = -std::atan(slope);

    const double noise = parameters.edge_noise * parameters.edge_noise;
    const double left_variance = left_sigma * left_sigma + noise;
    const double right_variance = right_sigma * right_sigma + noise;
    const double width_variance = left_variance + right_variance;
    const double bearing_rate = -1.0 / (camera.fx * (1.0 + slope * slope));  // dβ/dm
    const bool has_distance = !post.has(post_flag::no_distance);
    // An edge that was not seen lies anywhere up to a post's width farther out.
    const double hidden = has_distance ? 0.0 : post.width_px;
    post.covariance(1, 1) = bearing_rate * bearing_rate * (0.25 * width_variance + hidden * hidden) +
                            parameters.bearing_floor * parameters.bearing_floor;
    post.covariance(0, 1) = post.covariance(1, 0) = 0.0;
    if (!has_distance) {
        post.distance_m = 0.0;
        post.covariance(0, 0) = unknown_distance_sigma * unknown_distance_sigma;
        return;
    }
    const double gamma = pixel_angular_width(camera, left.line.direction() + right.line.direction());
    post.distance_m = diameter * gamma / post.width_px;
    const double distance_rate = -post.distance_m / post.width_px;  // dD/dw
    const double floor = parameters.distance_floor * post.distance_m;
    post.covariance(0, 0) = distance_rate * distance_rate * width_variance + floor * floor;
    post.covariance(0, 1) = distance_rate * bearing_rate * 0.5 * (right_variance - left_variance);
    post.covariance(1, 0) = post.covariance(0, 1);
}

}  // namespace goalmouth
