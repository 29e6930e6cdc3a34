#include "core/imaging/surface_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goalmouth {

namespace {

constexpr double noise = 3.0;          // levels: of a webcam, chroma's share of JPEG in it
constexpr double colour_spread = 0.1;  // of a level: σ of a surface's colour from place to place
constexpr double brightness_spread =
    0.25;                              // σ of its logarithm: vignetting, shading, exposure not followed yet
constexpr double grey_spread = 0.15;   // of a level: no camera's white balance is right
constexpr double darkest_grey = 0.04;  // of the scale
constexpr int steps = 12;              // of brightness
constexpr double least = 1e-6;         // density of what is beyond all bounds

double below(double level, double mean, double sigma) {
    return 0.5 * std::erfc((mean - level) / (sigma * std::numbers::sqrt2));
}

}  // namespace

SurfaceDensity::Levels SurfaceDensity::around(double mean, double spread) {
    const double sigma = std::hypot(spread * mean, noise);
    const double end = 1.0 - below(clipped_level, mean, sigma);
    Levels levels{};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double level = static_cast<double>(i);
        const double deviation = (level - mean) / sigma;
        const double density =
            std::exp(-0.5 * deviation * deviation) / (sigma * std::sqrt(2.0 * std::numbers::pi));
        levels[i] = static_cast<float>(std::max(least, level < clipped_level ? density : end));
    }
    return levels;
}

SurfaceDensity::Levels SurfaceDensity::evenly(double end) {
    Levels levels{};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double level = static_cast<double>(i);
        const double density =
            level < clipped_level ? below(end, level, noise) / end : 1.0 - clipped_level / end;
        levels[i] = static_cast<float>(std::max(least, density));
    }
    return levels;
}

SurfaceDensity SurfaceDensity::of_colour(const Eigen::Vector3d& levels, const ColourGains& gains) {
    const Eigen::Vector3d seen = levels.cwiseProduct(Eigen::Vector3d(gains.red, gains.green, gains.blue));
    SurfaceDensity density;
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const double sigmas = 5.0 * i / steps - 2.5;
        Brightness brightness;
        brightness.weight = static_cast<float>(std::exp(-0.5 * sigmas * sigmas));
        sum += static_cast<double>(brightness.weight);
        for (int c = 0; c < 3; ++c)
            brightness.channels[static_cast<std::size_t>(c)] =
                around(std::exp(brightness_spread * sigmas) * seen[c], colour_spread);
        density.brightnesses_.push_back(brightness);
    }
    for (Brightness& b : density.brightnesses_) b.weight /= static_cast<float>(sum);
    return density;
}

SurfaceDensity SurfaceDensity::of_greys(const ColourGains& gains) {
    SurfaceDensity density;
    for (int i = 0; i <= steps; ++i) {
        const double level = 255.0 * std::pow(darkest_grey, static_cast<double>(i) / steps);
        density.brightnesses_.push_back(
            {1.0F / (steps + 1),
             {around(gains.red * level, grey_spread), around(gains.green * level, grey_spread),
              around(gains.blue * level, grey_spread)}});
    }
    return density;
}

SurfaceDensity SurfaceDensity::of_anything(const ColourGains& gains) {
    SurfaceDensity density;
    density.brightnesses_.push_back(
        {1.0F, {evenly(255.0 * gains.red), evenly(255.0 * gains.green), evenly(255.0 * gains.blue)}});
    return density;
}

double SurfaceDensity::at(const Rgb& seen) const {
    const auto index = [](double level) {
        return static_cast<std::size_t>(std::clamp(std::lround(level), 0L, 255L));
    };
    const std::size_t red = index(seen.red), green = index(seen.green), blue = index(seen.blue);
    float sum = 0.0F;
    for (const Brightness& b : brightnesses_)
        sum += b.weight * b.channels[0][red] * b.channels[1][green] * b.channels[2][blue];
    return static_cast<double>(sum);
}

}  // namespace goalmouth
