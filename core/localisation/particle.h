#pragma once

#include "core/geometry/pose2.h"

#include <vector>

namespace goalmouth {

/// One guess at the robot's pose in field frame W.
struct Particle {
    Pose2 pose;
    double weight = 0.0;  // share of the belief; all together 1
};

using Particles = std::vector<Particle>;

}  // namespace goalmouth
