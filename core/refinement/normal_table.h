#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace goalmouth {

/// Φ and φ of a normal deviate, from a table and Taylor's series between its places: to 1e-6.
class NormalTable {
  public:
    static constexpr double per_sigma = 64.0, middle = 6.0 * per_sigma;
    static constexpr std::size_t places = 2 * static_cast<std::size_t>(middle) + 1;
    struct Normal {
        double below, density;
    };

    NormalTable() {
        for (std::size_t i = 0; i < places; ++i) {
            const double z = (static_cast<double>(i) - middle) / per_sigma;
            below_[i] = 0.5 * std::erfc(-z / std::numbers::sqrt2);
            density_[i] = std::exp(-0.5 * z * z) * (0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2);
        }
    }

    Normal at(double z) const {
        const double place = std::min(2.0 * middle, std::max(0.0, z * per_sigma + middle));  // NaN: 0
        const auto nearest = static_cast<std::size_t>(place + 0.5);
        const double whole = static_cast<double>(nearest), density = density_[nearest];
        const double here = (whole - middle) / per_sigma, d = (place - whole) / per_sigma;
        return {below_[nearest] + d * density * (1.0 - 0.5 * d * here),
                density * (1.0 - d * (here + 0.5 * d * (1.0 - here * here)))};
    }

    /// At z = (i − middle) / per_sigma.
    const double* below() const { return below_.data(); }
    const double* density() const { return density_.data(); }

  private:
    std::array<double, places> below_, density_;
};

}  // namespace goalmouth
