#include "core/imaging/calibration.h"

#include <cmath>
#include <numbers>

namespace goalmouth {

Intrinsics assumed_camera(int width, int height) {
    return from_horizontal_fov(width, height, std::numbers::pi / 3.0);
}

std::optional<Intrinsics> calibration_for(const Intrinsics& calibration, int width, int height) {
    if (calibration.width == width && calibration.height == height) return calibration;
    const double height_in_shape = static_cast<double>(calibration.height) * width / calibration.width;
    if (std::abs(height_in_shape - height) > 1.0) return std::nullopt;
    return scaled_to(calibration, width, height);
}

}  // namespace goalmouth
