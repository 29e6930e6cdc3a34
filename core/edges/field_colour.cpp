#include "core/edges/field_colour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace goalmouth {
namespace {

constexpr int bins = 48;
constexpr float reach = 1.F;  // |u|, |v| below this; more is no field's
constexpr float bin_size = 2.F * reach / bins;

int bin_of(float value) {
    return std::clamp(static_cast<int>((value + reach) / bin_size), 0, bins - 1);
}
float middle_of(int bin) {
    return (static_cast<float>(bin) + 0.5F) * bin_size - reach;
}

/// Nothing with more red in it belongs to the cluster.
constexpr float least_green = -0.03F;  // v

/// A field is green or, under coloured light, at least no redder than it is blue-green.
bool may_be_field(float u, float v) {
    return v < -0.05F && u < -0.6F * v;
}

}  // namespace

std::optional<FieldColour> FieldColourFinder::find(const std::vector<FieldSample>& samples,
                                                   float least_share) {
    fields_.assign(bins * bins, 0.F);
    all_.assign(bins * bins, 0.F);
    float total = 0.F;
    greenish_.clear();
    for (const FieldSample& s : samples) {
        const Chromaticity c = chromaticity(s.appearance);
        const auto bin = static_cast<std::size_t>(bin_of(c.v) * bins + bin_of(c.u));
        total += s.down;
        all_[bin] += s.down;
        if (c.v > least_green) continue;
        greenish_.push_back({c, s.down});
        if (may_be_field(c.u, c.v)) fields_[bin] += s.down;
    }
    const auto about = [](const std::vector<float>& histogram, int i, int j) {
        float sum = 0.F;
        for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di)
                sum += histogram[static_cast<std::size_t>((j + dj) * bins + i + di)];
        return sum;
    };
    float most = 0.F;
    int best_i = 1, best_j = 1;
    // Bins farther on are empty: v is less than 0.
    for (int j = 1; j <= bin_of(0.F) + 1; ++j) {
        for (int i = 1; i + 1 < bins; ++i) {
            const float sum = about(fields_, i, j);
            if (sum <= most) continue;
            most = sum;
            best_i = i;
            best_j = j;
        }
    }
    if (most < least_share * total || most <= 0.F) return std::nullopt;
    float u = middle_of(best_i);
    float v = middle_of(best_j);

    // What rises to a peak about grey is grey, as noise spreads it in the dark.
    float height = about(all_, best_i, best_j);
    for (bool climbing = true; climbing;) {
        climbing = false;
        const int i0 = best_i, j0 = best_j;
        for (int j = std::max(1, j0 - 1); j <= std::min(bins - 2, j0 + 1); ++j) {
            for (int i = std::max(1, i0 - 1); i <= std::min(bins - 2, i0 + 1); ++i) {
                const float sum = about(all_, i, j);
                if (sum <= height) continue;
                height = sum;
                best_i = i;
                best_j = j;
                climbing = true;
            }
        }
    }
    if (std::hypot(middle_of(best_i), middle_of(best_j)) < 0.5F * std::hypot(u, v)) return std::nullopt;

    // Mean and covariance of what lies about the middle, some times over.
    float suu = 0.05F * 0.05F;
    float suv = 0.F;
    float svv = suu;
    constexpr float least_sigma = 0.025F;
    constexpr float gate = 3.5F;  // sigmas
    for (int round = 0; round < 3; ++round) {
        const float det = suu * svv - suv * suv;
        double n = 0.0, mu = 0.0, mv = 0.0, muu = 0.0, muv = 0.0, mvv = 0.0;
        for (const Greenish& s : greenish_) {
            const float du = s.chromaticity.u - u;
            const float dv = s.chromaticity.v - v;
            const float d2 = (svv * du * du - 2.F * suv * du * dv + suu * dv * dv) / det;
            if (d2 > gate * gate) continue;
            const double w = s.down;
            n += w;
            mu += w * du;
            mv += w * dv;
            muu += w * du * du;
            muv += w * du * dv;
            mvv += w * dv * dv;
        }
        if (n <= 0.0) return std::nullopt;
        mu /= n;
        mv /= n;
        u += static_cast<float>(mu);
        v += static_cast<float>(mv);
        const float largest = 0.10F * 0.10F;
        suu = std::clamp(static_cast<float>(muu / n - mu * mu), least_sigma * least_sigma, largest);
        svv = std::clamp(static_cast<float>(mvv / n - mv * mv), least_sigma * least_sigma, largest);
        suv = static_cast<float>(muv / n - mu * mv);
        const float bound = 0.8F * std::sqrt(suu * svv);
        suv = std::clamp(suv, -bound, bound);
    }

    if (!may_be_field(u, v)) return std::nullopt;

    FieldColour field;
    field.e_.u = u;
    field.e_.v = v;
    const float det = suu * svv - suv * suv;
    field.e_.a = svv / (det * gate * gate);
    field.e_.b = -2.F * suv / (det * gate * gate);
    field.e_.c = suu / (det * gate * gate);
    field.e_.brightest = 256.F;
    lumas_.clear();
    for (const FieldSample& s : samples)
        if (field.contains(s.appearance)) lumas_.push_back(s.appearance.y);
    if (lumas_.empty()) return std::nullopt;
    const auto quantile = [&](double share) {
        const auto at =
            lumas_.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(lumas_.size() - 1));
        std::nth_element(lumas_.begin(), at, lumas_.end());
        return *at;
    };
    field.luma_ = quantile(0.5);
    field.e_.darkest = 0.7F * quantile(0.02);
    field.e_.brightest = 1.2F * quantile(0.98) + 6.F;
    return field;
}

}  // namespace goalmouth
