#include "core/geometry/camera.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

Eigen::Vector2d distort(const std::array<double, 5>& d, const Eigen::Vector2d& p) {
    const double x = p.x();
    const double y = p.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    return {x * radial + 2.0 * d[2] * x * y + d[3] * (r2 + 2.0 * x * x),
            y * radial + d[2] * (r2 + 2.0 * y * y) + 2.0 * d[3] * x * y};
}

}  // namespace

bool Intrinsics::has_distortion() const {
    return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
}

Intrinsics scaled_to(const Intrinsics& camera, int width, int height) {
    const double sx = static_cast<double>(width) / camera.width;
    const double sy = static_cast<double>(height) / camera.height;
    Intrinsics result = camera;
    result.width = width;
    result.height = height;
    result.fx = camera.fx * sx;
    result.fy = camera.fy * sy;
    result.cx = (camera.cx + 0.5) * sx - 0.5;
    result.cy = (camera.cy + 0.5) * sy - 0.5;
    return result;
}

Intrinsics from_horizontal_fov(int width, int height, double fov) {
    Intrinsics result;
    result.width = width;
    result.height = height;
    result.fx = result.fy = width / (2.0 * std::tan(fov / 2.0));  // paper, section 5: γ_x
    result.cx = (width - 1) / 2.0;
    result.cy = (height - 1) / 2.0;
    return result;
}

Eigen::Vector2d pixel_from_normalised(const Intrinsics& camera, const Eigen::Vector2d& normalised) {
    const Eigen::Vector2d p = camera.has_distortion() ? distort(camera.distortion, normalised) : normalised;
    return {camera.fx * p.x() + camera.cx, camera.fy * p.y() + camera.cy};
}

std::optional<Eigen::Vector2d> project(const Intrinsics& camera, const Eigen::Vector3d& point_C) {
    if (!(point_C.z() > 0.0)) return std::nullopt;
    return pixel_from_normalised(camera, point_C.head<2>() / point_C.z());
}

Eigen::Vector2d normalised_from_pixel(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d distorted{(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
    if (!camera.has_distortion()) return distorted;
    Eigen::Vector2d p = distorted;
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector2d error = distort(camera.distortion, p) - distorted;
        p -= error;
        if (error.squaredNorm() < 1e-26) break;
    }
    return p;
}

std::optional<Eigen::Vector2d> ground_point(const Intrinsics& camera, const Eigen::Isometry3d& T_WC,
                                            const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d n = normalised_from_pixel(camera, pixel);
    const Eigen::Vector3d direction = T_WC.linear() * Eigen::Vector3d(n.x(), n.y(), 1.0);
    if (!(direction.z() < -1e-9)) return std::nullopt;
    const double t = -T_WC.translation().z() / direction.z();
    if (!(t > 0.0) || !std::isfinite(t)) return std::nullopt;
    return (T_WC.translation() + t * direction).head<2>();
}

Eigen::Isometry3d camera_in_body(double height, double roll, double pitch, double yaw) {
    // Columns: the camera's axes (right, down, forward) in B for a camera that looks along body x.
    Eigen::Matrix3d level;
    level << 0, 0, 1,  //
        -1, 0, 0,      //
        0, -1, 0;
    Eigen::Isometry3d T_BC = Eigen::Isometry3d::Identity();
    T_BC.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * level *
                    Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
    T_BC.translation() = Eigen::Vector3d(0, 0, height);
    return T_BC;
}

}  // namespace goalmouth
