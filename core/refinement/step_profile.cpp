#include "core/refinement/step_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goalmouth {
namespace {

double density(double z) {
    return std::exp(-0.5 * z * z) * (0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2);
}

double share_below(double z) {
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace

void StepProfile::set_blur(double sigma, double digital_share) {
    if (sigma == sigma_ && digital_share == digital_) return;
    sigma_ = sigma;
    digital_ = digital_share;
    const double reach = 1.0 + 4.0 * sigma;
    reach_ = static_cast<float>(reach);
    scale_ = static_cast<float>((places - 1) / (2.0 * reach));
    constexpr int most_taps = 25;
    const int taps = std::min(most_taps, static_cast<int>(std::ceil(4.0 * sigma)));
    std::array<double, 2 * most_taps + 1> weight{};
    double sum = 0.0;
    for (int k = -taps; k <= taps; ++k)
        sum += weight[static_cast<std::size_t>(k + taps)] = std::exp(-0.5 * k * k / (sigma * sigma));
    // E(−x) = 1 − E(x): half of it is enough.
    for (std::size_t i = 0; i < places / 2; ++i) {
        const double x = 2.0 * reach * static_cast<double>(i) / (places - 1) - reach;
        const double upper = (x + 1.0) / sigma;
        const double lower = (x - 1.0) / sigma;
        const double p_upper = share_below(upper), p_lower = share_below(lower);
        const double d_upper = density(upper), d_lower = density(lower);
        const double step = 0.5 * ((x + 1.0) * p_upper - (x - 1.0) * p_lower + sigma * (d_upper - d_lower));
        const double slope = 0.5 * (p_upper - p_lower);
        double digital_step = 0.0, digital_slope = 0.0;
        for (int k = -taps; k <= taps; ++k) {
            const double w = weight[static_cast<std::size_t>(k + taps)] / sum;
            const double gathered = 0.5 * (x + k + 1.0);
            digital_step += w * std::clamp(gathered, 0.0, 1.0);
            digital_slope += gathered > 0.0 && gathered < 1.0 ? 0.5 * w : 0.0;
        }
        const Value value{static_cast<float>(step + digital_share * (digital_step - step)),
                          static_cast<float>(slope + digital_share * (digital_slope - slope)),
                          static_cast<float>(0.5 * (d_upper - d_lower)),
                          static_cast<float>(digital_step - step)};
        table_[i] = value;
        table_[places - 1 - i] = {1.0F - value.step, value.slope, -value.blur, -value.digital};
    }
}

}  // namespace goalmouth
