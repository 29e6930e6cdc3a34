#pragma once

#include "core/evaluation/evaluation_scene.h"
#include "core/geometry/camera_pose.h"
#include "core/random/random.h"

#include <optional>

#include <Eigen/Geometry>

namespace goalmouth {

/// What a robot would say of a camera at T_WC: body B stands upright on the ground under the camera, its axes
/// along those of W, so that all of the camera's lean is in T_BC. Errors are drawn from `random`: of the
/// attitude a rotation vector in B, of the height along z; the covariance is theirs. Nothing where the scene
/// says that nothing is told; the draws are the same then.
std::optional<CameraPose> measured_pose(const Eigen::Isometry3d& T_WC,
                                        const MeasuredPoseParameters& parameters, Random random);

}  // namespace goalmouth
