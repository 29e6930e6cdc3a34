#pragma once

#include "core/simulation/simulation.h"

#include <cstdint>

#include <goalmouth/kinematics_t.hpp>
#include <goalmouth/odometry_t.hpp>

namespace goalmouth {

/// What the robot measured of its camera's pose, with the uncertainty of the measurement.
kinematics_t kinematics_message(const SimulatedFrame& frame, std::int64_t utime, std::int64_t seq);

/// What the robot counted; `noise` states how far it may be off.
odometry_t odometry_message(const SimulatedFrame& frame, const OdometryParameters& noise, std::int64_t utime,
                            std::int64_t seq);

}  // namespace goalmouth
