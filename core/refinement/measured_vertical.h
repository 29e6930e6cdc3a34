#pragma once

#include "core/geometry/camera_pose.h"
#include "core/refinement/distance_cues.h"
#include "core/refinement/refinement_parameters.h"

#include <optional>

#include <Eigen/Core>

namespace goalmouth {

/// Which way is up along a post, as the camera's pose tells; frame C.
struct MeasuredVertical {
    Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // rad²
    std::optional<CameraStance> camera;                    // where the pose is known

    double sigma_about(const Eigen::Vector3d& direction) const;  // rad, of the part along a unit vector
};

/// Nothing known of the pose: about level.
MeasuredVertical measured_vertical(const std::optional<CameraPose>& pose,
                                   const RefinementParameters& parameters);

}  // namespace goalmouth
