#include "core/simulation/light.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

Light::Light(const LightParameters& parameters)
    : ambient_(static_cast<float>(parameters.ambient)),
      directional_(static_cast<float>(parameters.directional)),
      limb_darkening_(static_cast<float>(parameters.limb_darkening)),
      lamps_(std::cos(parameters.elevation) * std::cos(parameters.azimuth),
             std::cos(parameters.elevation) * std::sin(parameters.azimuth), std::sin(parameters.elevation)) {}

double Light::flat(const Eigen::Vector3d& normal) const {
    return static_cast<double>(ambient_) +
           static_cast<double>(directional_) * std::max(0.0, normal.dot(lamps_));
}

}  // namespace goalmouth
