#pragma once

#include <cstdint>

#include <Eigen/Geometry>
#include <goalmouth/kinematics_t.hpp>

namespace goalmouth {

/// T_BC of a kinematics message.
Eigen::Isometry3d camera_pose(const kinematics_t& message);

/// A kinematics message without uncertainty: a camera that is known to stand at T_BC.
kinematics_t kinematics_message(const Eigen::Isometry3d& T_BC, std::int64_t utime, std::int64_t seq);

}  // namespace goalmouth
