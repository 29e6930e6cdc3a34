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
    // Whole px, so that bends lie between two pieces.
    const int reach = 1 + static_cast<int>(std::ceil(4.0 * sigma));
    constexpr int most = static_cast<int>(most_pieces) - 2;                        // beside both ends
    const int dense = most / (2 * reach), sparse = (2 * reach + most - 1) / most;  // pieces a px; px a piece
    const double length = dense > 0 ? 1.0 / dense : sparse;
    const int inner_pieces = dense > 0 ? 2 * reach * dense : (2 * reach + sparse - 1) / sparse;
    const double first = -0.5 * length * inner_pieces;
    reach_ = static_cast<float>(-first);
    per_px_ = static_cast<float>(1.0 / length);
    count_ = static_cast<std::size_t>(inner_pieces) + 2;

    // E_d at whole px −reach … reach: Σ g_k C(n + k), where C is 0, ½ or 1.
    constexpr int most_taps = 25;
    const int taps = std::min(most_taps, static_cast<int>(std::ceil(4.0 * sigma)));
    std::array<double, 2 * most_taps + 1> weight{};
    double sum = 0.0;
    for (int k = -taps; k <= taps; ++k)
        sum += weight[static_cast<std::size_t>(k + taps)] = std::exp(-0.5 * k * k / (sigma * sigma));
    const auto digital_at = [&](int n) {
        double all = 0.0;
        for (int k = std::max(-taps, -n); k <= taps; ++k)
            all += (k == -n ? 0.5 : 1.0) * weight[static_cast<std::size_t>(k + taps)];
        return all / sum;
    };

    const auto digital_between = [&](double x) {
        const int n = static_cast<int>(std::floor(x));
        const double here = digital_at(n);
        return here + (x - n) * (digital_at(n + 1) - here);
    };
    struct End {
        double optical, slope, blur, digital;
    };
    const auto end_at = [&](double x) {
        const double upper = (x + 1.0) / sigma, lower = (x - 1.0) / sigma;
        const double p_upper = share_below(upper), p_lower = share_below(lower);
        const double d_upper = density(upper), d_lower = density(lower);
        return End{0.5 * ((x + 1.0) * p_upper - (x - 1.0) * p_lower + sigma * (d_upper - d_lower)),
                   0.5 * (p_upper - p_lower), 0.5 * (d_upper - d_lower), digital_between(x)};
    };
    tables_ = {};
    tables_[0][count_ - 1] = 1.0F;
    // E(−x) = 1 − E(x): half of the ends are enough.
    std::array<End, most_pieces> ends;
    for (int j = 0; 2 * j <= inner_pieces; ++j) {
        const End end = end_at(first + length * j);
        ends[static_cast<std::size_t>(inner_pieces - j)] = {1.0 - end.optical, end.slope, -end.blur,
                                                            1.0 - end.digital};
        ends[static_cast<std::size_t>(j)] = end;
    }
    const auto mixed = [&](double optical, double digital) {
        return optical + digital_share * (digital - optical);
    };
    for (std::size_t j = 0; j + 2 < count_; ++j) {
        const End& start = ends[j];
        const End& end = ends[j + 1];
        const double digital_slope = (end.digital - start.digital) / length;
        const double f0 = mixed(start.optical, start.digital), f1 = mixed(end.optical, end.digital);
        const double m0 = mixed(start.slope, digital_slope), m1 = mixed(end.slope, digital_slope);
        const double mean = (f1 - f0) / length;
        const double apart0 = start.digital - start.optical, apart1 = end.digital - end.optical;
        const std::array<double, 8> factors = {f0,
                                               m0,
                                               (3.0 * mean - 2.0 * m0 - m1) / length,
                                               (m0 + m1 - 2.0 * mean) / (length * length),
                                               start.blur,
                                               (end.blur - start.blur) / length,
                                               apart0,
                                               (apart1 - apart0) / length};
        for (std::size_t k = 0; k < factors.size(); ++k) tables_[k][j + 1] = static_cast<float>(factors[k]);
    }
}

}  // namespace goalmouth
