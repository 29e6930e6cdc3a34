#pragma once

#include "core/imaging/colour_gains.h"
#include "core/imaging/rgb.h"

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// How likely surfaces show levels that are seen, under gains, with what a camera adds to them: shading and
/// vignetting, which scale all three channels alike, a spread of each channel on its own, noise, and the end
/// of the scale. A density over levels; at the end of the scale, which is one level to it, all that would lie
/// beyond.
class SurfaceDensity {
  public:
    /// Surfaces of one colour [levels without the gains].
    static SurfaceDensity of_colour(const Eigen::Vector3d& levels, const ColourGains& gains);
    /// Grey surfaces, from black to white.
    static SurfaceDensity of_greys(const ColourGains& gains);
    /// Surfaces of any colour.
    static SurfaceDensity of_anything(const ColourGains& gains);

    double at(const Rgb& seen) const;

  private:
    using Levels = std::array<float, 256>;  // density of each level of a channel
    struct Brightness {
        float weight = 1.0F;
        std::array<Levels, 3> channels;
    };
    static Levels around(double mean, double spread);
    static Levels evenly(double end);

    std::vector<Brightness> brightnesses_;  // weights sum to 1
};

}  // namespace goalmouth
