#pragma once

#include "core/parameters/parameters.h"
#include "core/random/random.h"
#include "core/simulation/colour.h"

#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace goalmouth {

/// What the camera's automatic exposure and white balance do to the levels.
struct ExposureParameters {
    double gain = 1.0;
    double drift = 0.0;
    double white_balance = 6500.0;
    double white_balance_drift = 0.0;
    double drift_period = 20.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, ExposureParameters& p) {
    v("gain", p.gain, Range{0.01, 100}, "1", "levels for the light of a surface, before noise and clipping");
    v("drift", p.drift, Range{0, 2}, "1", "σ of the gain's natural logarithm as it wanders");
    v("white_balance", p.white_balance, Range{1700, 25000}, "K",
      "colour temperature at which the camera shows grey as grey");
    v("white_balance_drift", p.white_balance_drift, Range{0, 1}, "1",
      "σ of the natural logarithm of red and of blue against green as they wander");
    v("drift_period", p.drift_period, Range{0.1, 10000}, "s", "of the slowest part of the wander");
}

/// Gains of the three channels over time: gain · colour cast · exp(wander). The wander is a sum of sines of
/// incommensurate periods whose phases are drawn once for a run, so that it is smooth and never repeats. All
/// light of the hall has one colour temperature, which is why the cast can be a gain.
class Exposure {
  public:
    /// `light_temperature` [K]: of the light the camera looks at (LightParameters::temperature).
    Exposure(const ExposureParameters& parameters, double light_temperature, Random run);
    /// Factors for red, green, blue at `time` [s].
    Rgb gains(double time) const;

  private:
    static constexpr std::size_t waves = 3;
    double wander(std::size_t channel, double time) const;  // 0 overall, 1 red, 2 blue; σ 1 over a long run

    ExposureParameters parameters_;
    Rgb cast_;  // of the light's colour temperature against the white balance, green 1
    std::array<std::array<double, waves>, 3> phases_;
};

/// CIE 1931 chromaticity (x, y) of a black body of 1667…25000 K, by the cubic splines of Kang et al., Design
/// of advanced color temperature control system for HDTV applications, J. Korean Phys. Soc. 41, 2002; off by
/// less than 0.001. Colder and hotter ones count as the nearest of these.
Eigen::Vector2d planckian_chromaticity(double temperature);

/// Red, green and blue (linear, of the sRGB primaries) of a black body's light at a temperature [K], as
/// shares of those at `reference` [K], green 1.
Rgb light_colour(double temperature, double reference);

}  // namespace goalmouth
