#include "core/simulation/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goalmouth {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// Linear red, green, blue (IEC 61966-2-1 primaries) of a black body's light.
std::array<double, 3> black_body_rgb(double temperature) {
    const Eigen::Vector2d c = planckian_chromaticity(temperature);
    const double X = c.x() / c.y();
    const double Z = (1.0 - c.x() - c.y()) / c.y();
    return {3.2404542 * X - 1.5371385 - 0.4985314 * Z, -0.9692660 * X + 1.8760108 + 0.0415560 * Z,
            0.0556434 * X - 0.2040259 + 1.0572252 * Z};
}

}  // namespace

Eigen::Vector2d planckian_chromaticity(double temperature) {
    const double t = std::clamp(temperature, 1667.0, 25000.0);
    const double k = 1000.0 / t;
    const double x = t < 4000.0 ? ((-0.2661239 * k - 0.2343589) * k + 0.8776956) * k + 0.179910
                                : ((-3.0258469 * k + 2.1070379) * k + 0.2226347) * k + 0.240390;
    const double y = t < 2222.0   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                     : t < 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                  : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    return {x, y};
}

Rgb light_colour(double temperature, double reference) {
    const auto light = black_body_rgb(temperature);
    const auto grey = black_body_rgb(reference);
    // Candlelight lies outside the primaries' triangle, where blue would be negative: a camera's blue filter
    // still lets a little of it through.
    const auto share = [](const std::array<double, 3>& c, std::size_t channel) {
        return std::max(c[channel] / c[1], 0.01);
    };
    return {static_cast<float>(share(light, 0) / share(grey, 0)), 1.0F,
            static_cast<float>(share(light, 2) / share(grey, 2))};
}

Exposure::Exposure(const ExposureParameters& parameters, double light_temperature, Random run)
    : parameters_(parameters), cast_(light_colour(light_temperature, parameters.white_balance)) {
    for (auto& channel : phases_)
        for (double& phase : channel) phase = run.uniform(0.0, turn);
}

double Exposure::wander(std::size_t channel, double time) const {
    // Waves of equal height whose periods have no common multiple never repeat; the mean square of each sine
    // is one half.
    constexpr std::array<double, waves> frequency = {1.0, std::numbers::sqrt2, std::numbers::e};
    const double scale = std::sqrt(2.0 / static_cast<double>(waves));
    double sum = 0.0;
    for (std::size_t i = 0; i < waves; ++i)
        sum += std::sin(turn * frequency[i] * time / parameters_.drift_period + phases_[channel][i]);
    return scale * sum;
}

Rgb Exposure::gains(double time) const {
    const double gain = parameters_.gain * std::exp(parameters_.drift * wander(0, time));
    const double red = std::exp(parameters_.white_balance_drift * wander(1, time));
    const double blue = std::exp(parameters_.white_balance_drift * wander(2, time));
    return {static_cast<float>(gain * red) * cast_.r, static_cast<float>(gain) * cast_.g,
            static_cast<float>(gain * blue) * cast_.b};
}

}  // namespace goalmouth
