#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// A camera that moves evenly while a frame is taken: what rolling shutter and motion blur follow from.
struct CameraMotion {
    Eigen::Isometry3d T_WC = Eigen::Isometry3d::Identity();  // at the frame's time: the middle of the readout
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // m/s, of the camera's centre in W
    Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();     // rad/s, about the axes of C

    /// T_WC `seconds` after the frame's time: T(0) translated by velocity·t, then turned by turn_rate·t in C.
    Eigen::Isometry3d at(double seconds) const;
    bool still() const { return velocity.isZero() && turn_rate.isZero(); }
};

}  // namespace goalmouth
