#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// Where the camera was in body frame B: T_BC, and the covariance of (translation [m], rotation vector in B
/// [rad]).
struct CameraPose {
    Eigen::Isometry3d T_BC = Eigen::Isometry3d::Identity();
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

}  // namespace goalmouth
