#include "core/detection/ransac_parameters.h"

#include <cmath>

namespace goalmouth {

std::size_t attempts_needed(const RansacParameters& parameters, std::size_t inliers, std::size_t points,
                            std::size_t sample_size) {
    const auto attempts = static_cast<std::size_t>(parameters.attempts);
    if (parameters.confidence >= 1.0 || inliers == 0) return attempts;
    const double share = static_cast<double>(inliers) / static_cast<double>(points);
    const double pure = std::pow(share, static_cast<double>(sample_size));
    if (pure >= 1.0) return 1;
    const double needed = std::ceil(std::log1p(-parameters.confidence) / std::log1p(-pure));
    return needed < static_cast<double>(attempts) ? static_cast<std::size_t>(needed) : attempts;
}

}  // namespace goalmouth
