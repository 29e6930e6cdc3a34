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
    constexpr double near_enough = 1e-6;  // px
    constexpr double step = 1e-5;
    for (int i = 0; i < most_steps; ++i) {
        const Eigen::Vector2d here = pixel_from_normalised(camera_, point_);
        const Eigen::Vector2d miss = pixel - here;
        if (i > 0 && miss.squaredNorm() < near_enough * near_enough) break;
        Eigen::Matrix2d forward;
        forward.col(0) = (pixel_from_normalised(camera_, point_ + Eigen::Vector2d(step, 0.0)) - here) / step;
        forward.col(1) = (pixel_from_normalised(camera_, point_ + Eigen::Vector2d(0.0, step)) - here) / step;
        change_ = forward.inverse();
        point_ += change_ * miss;
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
        for (int i = 0; i < 2; ++i) {
            if (!(std::abs(x - result.x) < camera_.width)) break;
            result = at(x, y);
            x = result.crossing(plane);
        }
    } else if (std::isfinite(x)) {
        result = at(x, y);
    }
    result.x = x;
    return result;
}

}  // namespace goalmouth
