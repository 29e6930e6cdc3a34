#include "core/refinement/crossing_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace goalmouth {

void CrossingCurve::follow(const Intrinsics& camera, const Eigen::Vector3d& plane, double x_near,
                           double first_row, double last_row) {
    camera_ = camera;
    plane_ = plane;
    straight_ = !camera.has_distortion();
    if (straight_) return;
    constexpr int least_knots = 4;
    constexpr double per_focal_length = 64.0;
    const double length = std::max(1.0, last_row - first_row);
    // More than rows are of no use, whatever lens a message tells of.
    const double wanted = std::min(std::ceil(per_focal_length * length / camera.fy), std::ceil(length));
    const int knots = std::max(least_knots, 1 + static_cast<int>(wanted));
    first_row_ = first_row;
    pitch_ = length / (knots - 1);
    knots_.clear();
    PixelRays rays(camera);
    double x = x_near;
    for (int i = 0; i < knots; ++i) {
        const RowRay ray = rays.crossing(plane, x, first_row + i * pitch_);
        knots_.push_back({ray.x, ray.ray.x(), ray.ray.y(), ray.slope.x(), ray.slope.y()});
        if (std::isfinite(ray.x) && std::abs(ray.x) < 2.0 * camera.width) x = ray.x;
    }
}

RowRay CrossingCurve::at(double row) const {
    RowRay result;
    if (straight_) {
        // n · ((x − c_x)/f_x, (y − c_y)/f_y, 1) = 0.
        const double y = (row - camera_.cy) / camera_.fy;
        const double x = -(plane_.y() * y + plane_.z()) / plane_.x();
        result.x = camera_.fx * x + camera_.cx;
        result.ray = {x, y, 1.0};
        result.slope = {1.0 / camera_.fx, 0.0, 0.0};
        return result;
    }
    const double place = (row - first_row_) / pitch_;
    const auto most = static_cast<double>(knots_.size() - 4);
    const double before = std::clamp(std::floor(place) - 1.0, 0.0, most);
    const double t = place - before;  // 0 … 3, from the first of four
    const Knot* const k = knots_.data() + static_cast<std::size_t>(before);
    // Lagrange's cubics.
    const double a = t, b = t - 1.0, c = t - 2.0, d = t - 3.0;
    const double w0 = -b * c * d / 6.0, w1 = 0.5 * a * c * d, w2 = -0.5 * a * b * d, w3 = a * b * c / 6.0;
    const auto mixed = [&](double Knot::*part) {
        return w0 * k[0].*part + w1 * k[1].*part + w2 * k[2].*part + w3 * k[3].*part;
    };
    result.x = mixed(&Knot::x);
    result.ray = {mixed(&Knot::ray_x), mixed(&Knot::ray_y), 1.0};
    result.slope = {mixed(&Knot::slope_x), mixed(&Knot::slope_y), 0.0};
    return result;
}

}  // namespace goalmouth
