#pragma once

#include "core/parameters/parameters.h"
#include "core/random/random.h"
#include "core/simulation/colour.h"

#include <array>

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

/// Gains of the three channels over time: wanders smoothly about its settings, with phases drawn once for a
/// run.
class Exposure {
  public:
    /// `light_temperature` [K]: of the light the camera looks at (LightParameters::temperature).
    Exposure(const ExposureParameters& parameters, double light_temperature, Random run);
    /// Factors for red, green, blue at `time` [s].
    Rgb gains(double time) const;

  private:
    static constexpr std::size_t waves = 3;
    ExposureParameters parameters_;
    Rgb cast_;  // of the light's colour temperature against the white balance, green 1
    std::array<std::array<double, waves>, 3> phases_;
};

/// Red, green and blue of a black body's light at a temperature [K], as shares of those at `reference` [K],
/// green 1.
Rgb light_colour(double temperature, double reference);

}  // namespace goalmouth
