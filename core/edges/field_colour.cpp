#include "core/edges/field_colour.h"

#include <algorithm>
#include <cmath>

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
    histogram_.assign(bins * bins, 0.F);
    float total = 0.F;
    greenish_.clear();
    for (const FieldSample& s : samples) {
        const Chromaticity c = chromaticity(s.appearance);
        total += s.down;
        if (c.v > least_green) continue;
        greenish_.push_back({c, s.down});
        if (!may_be_field(c.u, c.v)) continue;
        histogram_[static_cast<std::size_t>(bin_of(c.v) * bins + bin_of(c.u))] += s.down;
    }
    float most = 0.F;
    float u = 0.F;
    float v = 0.F;
    // Bins farther on are empty: v is less than 0.
    for (int j = 1; j <= bin_of(0.F) + 1; ++j) {
        for (int i = 1; i + 1 < bins; ++i) {
            float sum = 0.F;
            for (int dj = -1; dj <= 1; ++dj)
                for (int di = -1; di <= 1; ++di)
                    sum += histogram_[static_cast<std::size_t>((j + dj) * bins + i + di)];
            if (sum > most) {
                most = sum;
                u = middle_of(i);
                v = middle_of(j);
            }
        }
    }
    if (most < least_share * total || most <= 0.F) return std::nullopt;

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
