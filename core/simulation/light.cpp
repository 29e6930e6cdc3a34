#include "core/simulation/light.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

Light::Light(const LightParameters& parameters)
    : ambient_(static_cast<float>(parameters.ambient)),
      directional_(static_cast<float>(parameters.directional)),
      limb_darkening_(static_cast<float>(parameters.limb_darkening)),
      shadows_(parameters.shadows),
      lamp_size_(parameters.lamp_size),
      lamps_(std::cos(parameters.elevation) * std::cos(parameters.azimuth),
             std::cos(parameters.elevation) * std::sin(parameters.azimuth), std::sin(parameters.elevation)) {}

double Light::flat(const Eigen::Vector3d& normal) const {
    return static_cast<double>(ambient_) +
           static_cast<double>(directional_) * std::max(0.0, normal.dot(lamps_));
}

double Light::lamps_share_on_ground() const {
    const double all = flat(Eigen::Vector3d::UnitZ());
    return all > 0.0 ? 1.0 - static_cast<double>(ambient_) / all : 0.0;
}

}  // namespace goalmouth
