#include "core/localisation/observation.h"

#include "core/geometry/pose2.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace goalmouth {
namespace {

constexpr int errors = 6;  // shift, tilt, width, rotation vector
using Errors = Eigen::Matrix<double, errors, 1>;

/// The functions of the errors that observe_post's documentation names.
struct Geometry {
    double plane_azimuth = 0.0;
    bool has_plane = false;
    double middle_azimuth = 0.0;
    double inverse_distance = 0.0;
};

struct Line {
    Eigen::Vector2d top;
    Eigen::Vector2d base;
    Eigen::Vector2d across;  // unit, to the right of the post's axis seen from top to base with base below
};

Eigen::Vector3d ray(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d n = normalised_from_pixel(camera, pixel);
    return {n.x(), n.y(), 1.0};
}

Line middle_line(const Post& post) {
    Line line;
    line.top = 0.5 * (post.left_top + post.right_top);
    line.base = 0.5 * (post.left_base + post.right_base);
    const Eigen::Vector2d along = line.base - line.top;
    const double length = along.norm();
    line.across =
        length > 1e-6 ? Eigen::Vector2d(along.y() / length, -along.x() / length) : Eigen::Vector2d(1, 0);
    return line;
}

Geometry geometry(const Line& line, double width, const Intrinsics& camera, const Eigen::Matrix3d& R_BC,
                  double radius, const Errors& e) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(e.tail<3>().norm(), e.tail<3>().norm() > 0.0
                                                  ? Eigen::Vector3d(e.tail<3>().normalized())
                                                  : Eigen::Vector3d(0, 0, 1)) *
        R_BC;
    const Eigen::Vector2d middle = 0.5 * (line.top + line.base) + e(0) * line.across;
    const Eigen::Vector3d r_m = R * ray(camera, middle);
    const Eigen::Vector3d r_t = R * ray(camera, line.top + (e(0) + e(1)) * line.across);
    const Eigen::Vector3d r_b = R * ray(camera, line.base + (e(0) - e(1)) * line.across);

    Geometry result;
    result.middle_azimuth = std::atan2(r_m.y(), r_m.x());
    const Eigen::Vector3d cross = r_t.cross(r_b);
    const double area = cross.norm();
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    if (area > 1e-6) {
        const Eigen::Vector3d n = cross / area;
        // A line that leans more than 60° is no upright post under this camera pose: only its middle means
        // anything.
        if (n.head<2>().norm() > 0.5) {
            Eigen::Vector2d d{-n.y(), n.x()};
            if (d.dot(r_m.head<2>()) < 0.0) d = -d;
            result.plane_azimuth = std::atan2(d.y(), d.x());
            result.has_plane = true;
            up = (up - n.z() * n).normalized();
        }
    }
    const double half = 0.5 * (width + e(2));
    const Eigen::Vector3d n_l = (R * ray(camera, middle - half * line.across)).cross(up);
    const Eigen::Vector3d n_r = (R * ray(camera, middle + half * line.across)).cross(up);
    const double angle = std::atan2(n_l.cross(n_r).norm(), n_l.dot(n_r));
    result.inverse_distance = std::sin(0.5 * angle) / radius;
    return result;
}

}  // namespace

CameraPose assumed_camera(const ObservationParameters& parameters) {
    CameraPose pose;
    pose.T_BC = camera_in_body(parameters.camera_height, 0.0, parameters.camera_pitch);
    const double variance = parameters.camera_angle_sigma * parameters.camera_angle_sigma;
    pose.covariance.diagonal().tail<3>().setConstant(variance);
    return pose;
}

std::optional<PostObservation> observe_post(const Post& post, const Intrinsics& camera,
                                            const CameraPose& pose, double post_diameter,
                                            const ObservationParameters& parameters) {
    if (post.has(post_flag::fills_image) || !(post.width_px > 0.0)) return std::nullopt;
    const bool has_distance = !post.has(post_flag::no_distance) && post.distance_m > 0.0;
    const bool refined = post.has(post_flag::refined);
    const double radius = 0.5 * post_diameter;
    const Line line = middle_line(post);
    const Eigen::Matrix3d R = pose.T_BC.linear();
    const Geometry at = geometry(line, post.width_px, camera, R, radius, Errors::Zero());

    // How far the middle moves in pixels for a radian of bearing: f (1 + x²), along the image's x.
    const double x = normalised_from_pixel(camera, 0.5 * (line.top + line.base)).x();
    const double px_per_rad = camera.fx * (1.0 + x * x);
    const double bearing_variance = std::max(0.0, post.covariance(1, 1));
    Eigen::Matrix<double, errors, errors> input = Eigen::Matrix<double, errors, errors>::Zero();
    const double line_sigma = refined ? parameters.refined_line_sigma : parameters.line_sigma;
    input(0, 0) = std::max(bearing_variance * px_per_rad * px_per_rad, line_sigma * line_sigma);
    input(1, 1) = 3.0 * input(0, 0);
    if (has_distance) {
        const double px_per_m = post.width_px / post.distance_m;
        input(2, 2) = std::max(0.0, post.covariance(0, 0)) * px_per_m * px_per_m;
        // Bearing grows to the left and distance with falling width: both signs turn, so the covariance keeps
        // its own.
        const double c = post.covariance(0, 1) * px_per_m * px_per_rad;
        const double limit = 0.99 * std::sqrt(input(0, 0) * input(2, 2));
        input(0, 2) = input(2, 0) = std::clamp(c, -limit, limit);
    }
    input.bottomRightCorner<3, 3>() = pose.covariance.bottomRightCorner<3, 3>();

    Eigen::Matrix<double, 3, errors> J;  // rows: plane azimuth, middle azimuth, inverse distance
    for (int i = 0; i < errors; ++i) {
        const double step = i < 2 ? 0.05 : i == 2 ? std::min(0.05, 0.1 * post.width_px) : 1e-4;
        Errors e = Errors::Zero();
        e(i) = step;
        const Geometry above = geometry(line, post.width_px, camera, R, radius, e);
        e(i) = -step;
        const Geometry below = geometry(line, post.width_px, camera, R, radius, e);
        J(0, i) =
            above.has_plane && below.has_plane ? wrap_angle(above.plane_azimuth - below.plane_azimuth) : 0.0;
        J(1, i) = wrap_angle(above.middle_azimuth - below.middle_azimuth);
        J(2, i) = above.inverse_distance - below.inverse_distance;
        J.col(i) /= 2.0 * step;
    }
    const Eigen::Matrix3d C = J * input * J.transpose();

    // Least variance of w·plane + (1 − w)·middle.
    double w = 0.0;
    if (at.has_plane) {
        const double denominator = C(0, 0) + C(1, 1) - 2.0 * C(0, 1);
        w = denominator > 1e-12 ? std::clamp((C(1, 1) - C(0, 1)) / denominator, 0.0, 1.0) : 1.0;
    }
    const double between = at.has_plane ? wrap_angle(at.plane_azimuth - at.middle_azimuth) : 0.0;
    const Eigen::RowVector3d mix(w, 1.0 - w, 0.0);

    PostObservation result;
    result.side = post.side;
    result.refined = refined;
    result.azimuth = wrap_angle(at.middle_azimuth + w * between);
    result.covariance(0, 0) = mix * C * mix.transpose();
    double nearness = at.inverse_distance;  // for the parallax of the camera's own position error
    double distance_floor = parameters.distance_floor;
    double distance_fraction_floor = parameters.distance_fraction_floor;
    double azimuth_floor = parameters.azimuth_floor;
    if (refined) {
        // What turns every post of the frame alike; what roll and pitch do beside that stays with each post.
        result.common_azimuth_variance = std::min(pose.covariance(5, 5), result.covariance(0, 0));
        distance_floor = parameters.refined_distance_floor;
        distance_fraction_floor = parameters.refined_distance_fraction_floor;
        azimuth_floor = parameters.refined_azimuth_floor;
    }
    if (has_distance) {
        if (refined) {
            nearness = 1.0 / post.distance_m;
            result.covariance(1, 1) = std::max(0.0, post.covariance(0, 0)) * std::pow(nearness, 4);
            const double azimuth_per_bearing = -mix.dot(J.col(0)) * px_per_rad;
            result.covariance(0, 1) = result.covariance(1, 0) =
                -azimuth_per_bearing * post.covariance(0, 1) * nearness * nearness;
        } else if (parameters.distance == "message") {
            nearness = 1.0 / post.distance_m;
            const double variance = std::max(0.0, post.covariance(0, 0));
            result.covariance(1, 1) = variance * std::pow(nearness, 4);
        } else {
            result.covariance(1, 1) = C(2, 2);
            result.covariance(0, 1) = result.covariance(1, 0) = mix * C.col(2);
        }
        // A camera inside the post, or a width no pixel resolves.
        if (!(nearness * radius < 0.999) || !(nearness > 1e-3)) return std::nullopt;
        result.has_distance = true;
        result.inverse_distance = nearness;
        const double floor = std::hypot(distance_floor, distance_fraction_floor / nearness);
        const double camera_variance = 0.5 * (pose.covariance(0, 0) + pose.covariance(1, 1));
        result.covariance(1, 1) += (floor * floor + camera_variance) * std::pow(nearness, 4) + 1e-10;
        result.covariance(0, 0) += camera_variance * nearness * nearness;
    }
    result.covariance(0, 0) += azimuth_floor * azimuth_floor;
    if (!std::isfinite(result.azimuth) || !std::isfinite(result.inverse_distance) ||
        !result.covariance.allFinite()) {
        return std::nullopt;
    }
    return result;
}

FrameObservation observe_posts(const std::vector<Post>& posts, const Intrinsics& camera,
                               const CameraPose& pose, double post_diameter,
                               const ObservationParameters& parameters) {
    FrameObservation result;
    result.camera = pose.T_BC.translation().head<2>();
    std::vector<std::size_t> order(posts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Ties by place in the image, so that the order in the message does not matter.
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (posts[a].width_px != posts[b].width_px) return posts[a].width_px > posts[b].width_px;
        if (posts[a].bearing_rad != posts[b].bearing_rad) return posts[a].bearing_rad > posts[b].bearing_rad;
        return a < b;
    });
    for (const std::size_t i : order) {
        std::optional<PostObservation> observation;
        if (result.posts.size() < static_cast<std::size_t>(parameters.most_posts)) {
            observation = observe_post(posts[i], camera, pose, post_diameter, parameters);
        }
        if (observation) {
            result.posts.push_back(*observation);
        } else {
            ++result.unusable;
        }
    }
    return result;
}

}  // namespace goalmouth
