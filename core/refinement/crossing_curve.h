#pragma once

#include "core/geometry/camera.h"
#include "core/refinement/pixel_rays.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Where a plane through the camera's centre crosses a picture's rows: a smooth curve, which is followed
/// through the lens in a few rows and is a cubic through four of them in between.
///
/// The rows are f/64 apart: for lenses as they come that is within 1e-3 px of the exact crossing. A lens
/// without distortion has straight lines, which are exact.
class CrossingCurve {
  public:
    /// Between two rows; `x_near` [px]: about where the plane crosses the first.
    void follow(const Intrinsics& camera, const Eigen::Vector3d& plane, double x_near, double first_row,
                double last_row);

    /// The crossing and the pixel's ray there; not finite where the plane runs along the rows.
    RowRay at(double row) const;

  private:
    struct Knot {
        double x, ray_x, ray_y, slope_x, slope_y;
    };
    Intrinsics camera_;
    Eigen::Vector3d plane_ = Eigen::Vector3d::UnitX();
    bool straight_ = true;
    double first_row_ = 0.0;
    double pitch_ = 1.0;  // px between knots
    std::vector<Knot> knots_;
};

}  // namespace goalmouth
