#pragma once

#include "core/geometry/camera.h"

#include <Eigen/Core>

namespace goalmouth {

/// A pixel's ray in frame C, (x/z, y/z, 1) without distortion, and how it changes from pixel to pixel along
/// the row.
struct RowRay {
    double x = 0.0;  // px, the column it belongs to
    Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d slope = Eigen::Vector3d::UnitX();  // per px

    /// Column [px] in which a plane through the camera's centre cuts the row, the lens taken as linear from
    /// `x` on; not finite for a plane along the row.
    double crossing(const Eigen::Vector3d& plane) const { return x - plane.dot(ray) / plane.dot(slope); }
};

/// Rays of pixels that come one near the other: each is found from the one before by Newton steps, where
/// normalised_from_pixel would start anew.
class PixelRays {
  public:
    explicit PixelRays(const Intrinsics& camera) : camera_(camera), distorted_(camera.has_distortion()) {}
    RowRay at(double x, double y);
    /// The pixel row's crossing with a plane, the lens followed: exact to 1e-6 px for usual lenses.
    RowRay crossing(const Eigen::Vector3d& plane, double x_near, double y);

  private:
    Intrinsics camera_;
    bool distorted_;
    bool started_ = false;
    Eigen::Vector2d pixel_ = Eigen::Vector2d::Zero();
    Eigen::Vector2d point_ = Eigen::Vector2d::Zero();       // normalised
    Eigen::Matrix2d change_ = Eigen::Matrix2d::Identity();  // of the normalised point per pixel
};

}  // namespace goalmouth
