#include "core/refinement/pixel_rays.h"

#include <cmath>

#include <Eigen/LU>

namespace goalmouth {

RowRay PixelRays::at(double x, double y) {
    RowRay result;
    result.x = x;
    if (!distorted_) {
        result.ray = {(x - camera_.cx) / camera_.fx, (y - camera_.cy) / camera_.fy, 1.0};
        result.slope = {1.0 / camera_.fx, 0.0, 0.0};
        return result;
    }
    const Eigen::Vector2d pixel(x, y);
    if (!started_) {
        point_ = normalised_from_pixel(camera_, pixel);
        started_ = true;
    } else {
        point_ += change_ * (pixel - pixel_);
    }
    constexpr int most_steps = 6;
    // Newton steps square what is missing, in px about times 1e-3: after one from here nothing is.
    constexpr double near_enough = 0.01;  // px
    for (int i = 0; i < most_steps; ++i) {
        const Eigen::Vector2d miss = pixel - pixel_from_normalised(camera_, point_);
        change_ = pixel_change(camera_, point_).inverse();
        point_ += change_ * miss;
        if (miss.squaredNorm() < near_enough * near_enough) break;
    }
    if (!point_.allFinite() || !change_.allFinite()) {  // where the lens model folds back
        point_ = normalised_from_pixel(camera_, pixel);
        change_ = Eigen::Vector2d(1.0 / camera_.fx, 1.0 / camera_.fy).asDiagonal();
    }
    pixel_ = pixel;
    result.ray = {point_.x(), point_.y(), 1.0};
    result.slope = {change_(0, 0), change_(1, 0), 0.0};
    return result;
}

RowRay PixelRays::crossing(const Eigen::Vector3d& plane, double x_near, double y) {
    RowRay result = at(x_near, y);
    double x = result.crossing(plane);
    if (distorted_) {
        // Over a hundredth of a px a lens is as good as linear.
        constexpr double near_enough = 0.01;
        for (int i = 0; i < 3 && !(std::abs(x - result.x) < near_enough); ++i) {
            if (!(std::abs(x - result.x) < camera_.width)) break;
            result = at(x, y);
            x = result.crossing(plane);
        }
        if (std::isfinite(x)) result.ray += (x - result.x) * result.slope;
    } else if (std::isfinite(x)) {
        result = at(x, y);
    }
    result.x = x;
    return result;
}

}  // namespace goalmouth
