#pragma once

#include "core/geometry/camera.h"

#include <optional>

namespace goalmouth {

/// A camera nobody calibrated: no distortion, 60° wide (paper, section 3: Logitech C905).
Intrinsics assumed_camera(int width, int height);

/// The calibration for images of width × height px: scaled where only the resolution differs; nothing where
/// the shape does (by more than a pixel), because then another part of the sensor is seen.
std::optional<Intrinsics> calibration_for(const Intrinsics& calibration, int width, int height);

}  // namespace goalmouth
