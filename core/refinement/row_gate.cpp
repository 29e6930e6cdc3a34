#include "core/refinement/row_gate.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr double tukey = 6.0;  // sigmas; 98 % efficient where nothing is wrong

float middle_of(std::vector<float>& values) {
    if (values.empty()) return 0.0F;
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
}

/// χ²/n of n degrees of freedom that a normal deviate of `sigmas` stands for (Wilson and Hilferty, 1931).
double mean_square(double n, double sigmas) {
    const double t = 2.0 / (9.0 * n);
    const double root = std::max(0.05, 1.0 - t + sigmas * std::sqrt(t));
    return root * root * root;
}

float third_of(std::vector<float>& values) {
    if (values.empty()) return 0.0F;
    const auto third = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 3);
    std::nth_element(values.begin(), third, values.end());
    return *third;
}

}  // namespace

void RowGate::weigh(std::array<std::vector<EdgeRow>, 2>& rows, std::array<double, 2>& noise, bool gate) {
    for (std::size_t side = 0; side < 2; ++side) {
        sorted_.clear();
        for (const EdgeRow& row : rows[side])
            if (row.seen && row.information > 0.0F) sorted_.push_back(row.misfit);
        // A third of the rows tells the noise: fewer than that are never clean. That the pixels are noisier
        // than the colours' own noise says, by more than this, is the background's doing.
        constexpr double cleanest = 0.3, noisiest = 2.5, third = -0.431;
        if (sorted_.empty()) continue;
        double freedom = 0.0;
        for (const EdgeRow& row : rows[side])
            if (row.seen && row.information > 0.0F) freedom += static_cast<double>(row.freedom);
        freedom_[side] = std::max(1.0, freedom / static_cast<double>(sorted_.size()));
        noise[side] = std::clamp(static_cast<double>(third_of(sorted_)) / mean_square(freedom_[side], third),
                                 cleanest, noisiest);
    }

    sorted_.clear();
    const double rough = edge_roughness * edge_roughness;
    for (const auto& side_rows : rows) {
        for (const EdgeRow& row : side_rows) {
            if (!row.seen || !(row.information > 0.0F)) continue;
            const double variance = 1.0 / static_cast<double>(row.information) + rough;
            sorted_.push_back(
                static_cast<float>(std::abs(static_cast<double>(row.offset)) / std::sqrt(variance)));
        }
    }
    const double spread = std::max(1.0, 1.4826 * static_cast<double>(middle_of(sorted_)));
    for (std::size_t side = 0; side < 2; ++side) {
        std::vector<EdgeRow>& all = rows[side];
        const double own_usual = mean_square(freedom_[side], 2.0),
                     own_most = mean_square(freedom_[side], 4.5);
        const double local_usual = mean_square(5.0 * freedom_[side], 2.3),
                     local_most = mean_square(5.0 * freedom_[side], 5.0);
        for (std::size_t i = 0; i < all.size(); ++i) {
            EdgeRow& row = all[i];
            row.weight = 0.0F;
            if (!row.seen || !(row.information > 0.0F)) continue;
            const double variance = 1.0 / static_cast<double>(row.information) + rough;
            const double miss = static_cast<double>(row.offset) / (std::sqrt(variance) * spread * tukey);
            const double far = 1.0 - miss * miss;
            if (far <= 0.0) continue;
            double weight = far * far;
            if (gate) {
                // What lies behind a post or before it does so in several rows, and where it begins and ends
                // it disturbs less than can be seen in one row.
                double sum = 0.0, count = 0.0;
                for (std::size_t k = i < 2 ? 0 : i - 2; k < std::min(all.size(), i + 3); ++k) {
                    if (!all[k].seen || !(all[k].information > 0.0F)) continue;
                    sum += static_cast<double>(all[k].misfit);
                    count += 1.0;
                }
                const double local = sum / (count * noise[side]);
                const double own = static_cast<double>(row.misfit) / noise[side];
                const double unlike = std::max({0.0, (local - local_usual) / (local_most - local_usual),
                                                (own - own_usual) / (own_most - own_usual)});
                const double clean = 1.0 - unlike * unlike;
                weight *= clean <= 0.0 ? 0.0 : clean * clean;
            }
            row.weight = static_cast<float>(weight);
        }
    }
}

}  // namespace goalmouth
