#include "core/simulation/exposure.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(LightColour, BlackBodiesHaveThePublishedChromaticities) {
    // CIE 1931 2°; 2856 K is standard illuminant A.
    struct {
        double temperature, x, y;
    } const published[] = {{2000, 0.5267, 0.4133}, {2856, 0.4476, 0.4074},  {3000, 0.4369, 0.4041},
                           {4000, 0.3805, 0.3768}, {5000, 0.3451, 0.3516},  {6500, 0.3135, 0.3237},
                           {8000, 0.2952, 0.3048}, {10000, 0.2807, 0.2884}, {20000, 0.2565, 0.2577}};
    for (const auto& p : published) {
        const Eigen::Vector2d c = planckian_chromaticity(p.temperature);
        EXPECT_NEAR(c.x(), p.x, 0.001) << p.temperature;
        EXPECT_NEAR(c.y(), p.y, 0.001) << p.temperature;
    }
}

TEST(LightColour, OfTheReferenceIsWhite) {
    for (const double t : {1700.0, 2856.0, 6500.0, 25000.0}) {
        const Rgb c = light_colour(t, t);
        EXPECT_FLOAT_EQ(c.r, 1.0F);
        EXPECT_FLOAT_EQ(c.g, 1.0F);
        EXPECT_FLOAT_EQ(c.b, 1.0F);
    }
}

TEST(LightColour, GoesFromRedToBlue) {
    Rgb last = light_colour(2000.0, 6500.0);
    for (double t = 2100.0; t <= 25000.0; t += 100.0) {
        const Rgb c = light_colour(t, 6500.0);
        EXPECT_LT(c.r, last.r) << t;
        EXPECT_GT(c.b, last.b) << t;
        EXPECT_EQ(c.g, 1.0F);
        last = c;
    }
    // Incandescent light before a camera set to daylight: about twice as much red, a quarter of the blue.
    const Rgb lamp = light_colour(2856.0, 6500.0);
    EXPECT_NEAR(lamp.r, 2.11F, 0.03F);
    EXPECT_NEAR(lamp.b, 0.269F, 0.01F);
    EXPECT_GT(light_colour(1700.0, 6500.0).b, 0.0F);
}

TEST(LightColour, RatiosUndoEachOther) {
    const Rgb there = light_colour(3200.0, 5000.0);
    const Rgb back = light_colour(5000.0, 3200.0);
    EXPECT_NEAR(there.r * back.r, 1.0F, 1e-5F);
    EXPECT_NEAR(there.b * back.b, 1.0F, 1e-5F);
}

TEST(Exposure, WithoutDriftIsTheGainAndTheCast) {
    const Exposure exposure({.gain = 1.5, .white_balance = 5000.0}, 4000.0, Random(1));
    const Rgb cast = light_colour(4000.0, 5000.0);
    for (const double t : {0.0, 7.3, 1e4}) {
        const Rgb g = exposure.gains(t);
        EXPECT_FLOAT_EQ(g.r, 1.5F * cast.r);
        EXPECT_FLOAT_EQ(g.g, 1.5F);
        EXPECT_FLOAT_EQ(g.b, 1.5F * cast.b);
    }
}

TEST(Exposure, DefaultsChangeNothing) {
    const Rgb g = Exposure({}, 6500.0, Random(1)).gains(12.0);
    EXPECT_EQ(g.r, 1.0F);
    EXPECT_EQ(g.g, 1.0F);
    EXPECT_EQ(g.b, 1.0F);
}

TEST(Exposure, WandersWithTheStatedSigma) {
    const Exposure exposure({.gain = 2.0, .drift = 0.2, .white_balance_drift = 0.05, .drift_period = 20.0},
                            6500.0, Random(3));
    double green = 0.0, green2 = 0.0, red2 = 0.0, blue2 = 0.0, red_blue = 0.0;
    constexpr int n = 200000;
    for (int i = 0; i < n; ++i) {
        const Rgb g = exposure.gains(0.37 * i);
        const double level = std::log(static_cast<double>(g.g) / 2.0);
        const double red = std::log(static_cast<double>(g.r / g.g));
        const double blue = std::log(static_cast<double>(g.b / g.g));
        green += level / n;
        green2 += level * level / n;
        red2 += red * red / n;
        blue2 += blue * blue / n;
        red_blue += red * blue / n;
    }
    EXPECT_NEAR(green, 0.0, 0.002);
    EXPECT_NEAR(std::sqrt(green2), 0.2, 0.002);
    EXPECT_NEAR(std::sqrt(red2), 0.05, 0.0005);
    EXPECT_NEAR(std::sqrt(blue2), 0.05, 0.0005);
    EXPECT_LT(std::abs(red_blue), 0.05 * 0.05);  // not one and the same wander
}

TEST(Exposure, WandersSmoothlyAndNeverRepeats) {
    const ExposureParameters parameters{.drift = 0.3, .drift_period = 10.0};
    const Exposure exposure(parameters, 6500.0, Random(1));
    double largest = 0.0, nearest = 1.0;
    for (double t = 0.0; t < 100.0; t += 1.0 / 30.0)
        largest = std::max(largest, std::abs(static_cast<double>(exposure.gains(t + 1.0 / 30.0).g) -
                                             static_cast<double>(exposure.gains(t).g)));
    EXPECT_LT(largest, 0.05);
    for (int period = 1; period <= 3; ++period) {
        double difference = 0.0;
        for (double t = 0.0; t < 10.0; t += 0.5)
            difference =
                std::max(difference, std::abs(static_cast<double>(exposure.gains(t).g) -
                                              static_cast<double>(exposure.gains(t + 10.0 * period).g)));
        nearest = std::min(nearest, difference);
    }
    EXPECT_GT(nearest, 0.02);
    EXPECT_NE(exposure.gains(3.0).g, Exposure(parameters, 6500.0, Random(2)).gains(3.0).g);
    EXPECT_EQ(exposure.gains(3.0).g, Exposure(parameters, 6500.0, Random(1)).gains(3.0).g);
}

}  // namespace
}  // namespace goalmouth
