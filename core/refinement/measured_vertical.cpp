#include "core/refinement/measured_vertical.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

double MeasuredVertical::sigma_about(const Eigen::Vector3d& direction) const {
    return std::sqrt(std::max(0.0, direction.dot(covariance * direction)));
}

MeasuredVertical measured_vertical(const std::optional<CameraPose>& pose,
                                   const RefinementParameters& parameters) {
    MeasuredVertical result;
    const double lean = parameters.tilt_floor;
    if (!pose || !pose->T_BC.matrix().allFinite() || !pose->covariance.allFinite()) {
        result.covariance =
            (parameters.level_sigma * parameters.level_sigma + lean * lean) * Eigen::Matrix3d::Identity();
        return result;
    }
    const Eigen::Matrix3d R_BC = pose->T_BC.linear();
    result.up = R_BC.transpose() * Eigen::Vector3d::UnitZ();
    // A small turn ω in B moves the vertical, seen from C, by R_BCᵀ (e_z × ω).
    Eigen::Matrix3d turn;
    turn << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    const Eigen::Matrix3d change = R_BC.transpose() * turn;
    result.covariance = change * pose->covariance.bottomRightCorner<3, 3>() * change.transpose() +
                        lean * lean * Eigen::Matrix3d::Identity();
    result.camera = CameraStance{pose->T_BC.translation().z(), pose->covariance(2, 2),
                                 change * pose->covariance.block<3, 1>(3, 2)};
    return result;
}

}  // namespace goalmouth
