#pragma once

#include "core/geometry/camera.h"

#include <Eigen/Geometry>

namespace goalmouth {

/// How a camera sees the ground and the posts on it, where that is known.
struct CameraOverGround {
    Intrinsics camera;       // of the picture
    Eigen::Isometry3d T_BC;  // frame B: z = 0 is the ground
    double diameter = 0.1;   // m, of posts
};

}  // namespace goalmouth
