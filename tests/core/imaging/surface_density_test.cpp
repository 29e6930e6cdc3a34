#include "core/imaging/surface_density.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

const Eigen::Vector3d yellow(226, 184, 34);

/// The sum over all levels of all channels: the end of the scale counts once.
double total(const SurfaceDensity& density) {
    constexpr double step = 3.0;
    const double end = clipped_level;
    double sum = 0.0;
    for (double red = 1.0; red < end + step; red += step)
        for (double green = 1.0; green < end + step; green += step)
            for (double blue = 1.0; blue < end + step; blue += step) {
                const auto levels = [&](double level) { return level < end ? step : 1.0; };
                sum += levels(red) * levels(green) * levels(blue) * density.at({red, green, blue});
            }
    return sum;
}

TEST(SurfaceDensity, IsADensity) {
    for (const ColourGains& gains : {ColourGains{1.0, 1.0, 1.0}, ColourGains{1.9, 3.0, 6.0}}) {
        EXPECT_NEAR(total(SurfaceDensity::of_colour(yellow, gains)), 1.0, 0.1);
        EXPECT_NEAR(total(SurfaceDensity::of_anything(gains)), 1.0, 0.1);
    }
}

TEST(SurfaceDensity, IsHighestAtTheColourUnderTheGains) {
    const SurfaceDensity density = SurfaceDensity::of_colour(yellow, {0.5, 0.4, 0.3});
    const double there = density.at({113.0, 73.6, 10.2});
    EXPECT_GT(there, density.at({226.0, 184.0, 34.0}));
    EXPECT_GT(there, density.at({113.0, 73.6, 40.0}));
    EXPECT_GT(density.at({79.0, 51.5, 7.1}), 1e3 * density.at({79.0, 51.5, 40.0})) << "shaded";
}

TEST(SurfaceDensity, HasAtTheEndOfTheScaleAllThatLiesBeyond) {
    const SurfaceDensity density = SurfaceDensity::of_colour(yellow, {3.0, 3.0, 1.0});
    EXPECT_GT(density.at({255.0, 255.0, 34.0}), 1e3 * density.at({240.0, 240.0, 34.0}));
    EXPECT_DOUBLE_EQ(density.at({255.0, 255.0, 34.0}), density.at({250.0, 262.0, 34.0}));
}

TEST(SurfaceDensity, OfGreysHasTheColourOfTheLight) {
    const SurfaceDensity density = SurfaceDensity::of_greys({0.5, 0.4, 0.2});
    EXPECT_GT(density.at({50.0, 40.0, 20.0}), 10.0 * density.at({40.0, 40.0, 40.0}));
    EXPECT_GT(density.at({100.0, 80.0, 40.0}), 10.0 * density.at({100.0, 40.0, 5.0}));
}

}  // namespace
}  // namespace goalmouth
