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

/// Whether the radial part grows all the way from 0 to a radius, given squared: its derivative along the
/// radius is 1 + 3·k1·s + 5·k2·s² + 7·k3·s³ at s = r².
bool grows_until(const std::array<double, 5>& d, double radius2) {
    const auto slope = [&](double s) { return 1.0 + s * (3.0 * d[0] + s * (5.0 * d[1] + s * 7.0 * d[4])); };
    if (!(slope(radius2) > 0.0)) return false;
    // Where it may be least: c + b·s + a·s² = 0.
    const double a = 21.0 * d[4], b = 10.0 * d[1], c = 3.0 * d[0];
    const auto falls_to_zero = [&](double s) { return s > 0.0 && s < radius2 && !(slope(s) > 0.0); };
    if (a == 0.0) return !(b != 0.0 && falls_to_zero(-c / b));
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) return true;
    const double root = std::sqrt(discriminant);
    return !falls_to_zero((-b - root) / (2.0 * a)) && !falls_to_zero((-b + root) / (2.0 * a));
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

Eigen::Matrix2d pixel_change(const Intrinsics& camera, const Eigen::Vector2d& normalised) {
    const std::array<double, 5>& d = camera.distortion;
    const double x = normalised.x(), y = normalised.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    const double growth = 2.0 * (d[0] + r2 * (2.0 * d[1] + r2 * 3.0 * d[4]));
    const double across = x * y * growth + 2.0 * (d[2] * x + d[3] * y);
    Eigen::Matrix2d change;
    change << camera.fx * (radial + x * x * growth + 2.0 * d[2] * y + 6.0 * d[3] * x), camera.fx * across,
        camera.fy * across, camera.fy * (radial + y * y * growth + 6.0 * d[2] * y + 2.0 * d[3] * x);
    return change;
}

std::optional<Eigen::Vector2d> project(const Intrinsics& camera, const Eigen::Vector3d& point_C) {
    if (!(point_C.z() > 0.0)) return std::nullopt;
    return pixel_from_normalised(camera, point_C.head<2>() / point_C.z());
}

bool folds_back(const Intrinsics& camera, const Eigen::Vector2d& normalised) {
    if (!camera.has_distortion()) return false;
    if (!grows_until(camera.distortion, normalised.squaredNorm())) return true;
    constexpr double step = 1e-4;  // the tangential part may fold as well
    const Eigen::Vector2d principal(camera.cx, camera.cy);
    const auto radius = [&](const Eigen::Vector2d& n) {
        return (pixel_from_normalised(camera, n) - principal).norm();
    };
    return radius((1.0 + step) * normalised) < radius(normalised);
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
