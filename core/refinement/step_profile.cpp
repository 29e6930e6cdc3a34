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
    constexpr int dense = static_cast<int>(per_px);
    constexpr double length = 1.0 / static_cast<double>(per_px);  // px, of a piece
    // Whole px, so that bends lie between two pieces.
    const int reach = 1 + static_cast<int>(std::ceil(4.0 * sigma));
    reach_ = static_cast<float>(reach);

    // Knots one px farther than the profile reaches, to either side. Φ(−z) = 1 − Φ(z): half of them is
    // enough.
    const int half = (reach + 1) * dense;
    knots_.resize(static_cast<std::size_t>(2 * half + 1));
    for (int j = 0; j <= half; ++j) {
        const double x = length * j, z = x / sigma;
        const double beyond = share_below(-z), d = density(z);
        const double gathered = x * (1.0 - beyond) + sigma * d;
        knots_[static_cast<std::size_t>(half + j)] = {1.0 - beyond, d, gathered};
        knots_[static_cast<std::size_t>(half - j)] = {beyond, d, gathered - x};
    }

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

    const int inner_pieces = 2 * reach * dense;
    pieces_.assign(static_cast<std::size_t>(inner_pieces) + 2, {});
    struct End {
        double optical, slope, blur;
    };
    const auto end_of = [&](int j) {  // of the piece j, from −reach on
        const Knot& upper = knots_[static_cast<std::size_t>(j + 2 * dense)];
        const Knot& lower = knots_[static_cast<std::size_t>(j)];
        return End{0.5 * (upper.gathered - lower.gathered), 0.5 * (upper.below - lower.below),
                   0.5 * (upper.density - lower.density)};
    };
    double before = digital_at(-reach), after = before;
    End start = end_of(0);
    for (int j = 0; j < inner_pieces; ++j) {
        const int in_px = j % dense;
        if (in_px == 0) before = after, after = digital_at(j / dense - reach + 1);
        const End end = end_of(j + 1);
        const double digital_slope = after - before;
        const double digital_start = before + in_px * length * digital_slope;
        const double digital_end = digital_start + length * digital_slope;
        const auto mixed = [&](double optical, double digital) {
            return optical + digital_share * (digital - optical);
        };
        const double f0 = mixed(start.optical, digital_start), f1 = mixed(end.optical, digital_end);
        const double m0 = mixed(start.slope, digital_slope), m1 = mixed(end.slope, digital_slope);
        const double mean = (f1 - f0) / length;
        Piece& piece = pieces_[static_cast<std::size_t>(j) + 1];
        piece.step = {static_cast<float>(f0), static_cast<float>(m0),
                      static_cast<float>((3.0 * mean - 2.0 * m0 - m1) / length),
                      static_cast<float>((m0 + m1 - 2.0 * mean) / (length * length))};
        piece.blur = {static_cast<float>(start.blur), static_cast<float>((end.blur - start.blur) / length)};
        const double apart0 = digital_start - start.optical, apart1 = digital_end - end.optical;
        piece.digital = {static_cast<float>(apart0), static_cast<float>((apart1 - apart0) / length)};
        start = end;
    }
    pieces_.back().step[0] = 1.0F;
}

}  // namespace goalmouth
