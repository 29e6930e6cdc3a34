#include "core/simulation/coverage.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(EdgeCoverage, IsTheAreaOfTheCutSquare) {
    for (const double angle : {0.0, 0.2, 0.7853981633974483, 1.1, 1.5707963267948966, 2.5, 4.0}) {
        const double gu = std::cos(angle);
        const double gv = std::sin(angle);
        const EdgeCoverage coverage(static_cast<float>(gu), static_cast<float>(gv));
        for (double s = -0.9; s <= 0.9; s += 0.075) {
            constexpr int n = 400;
            int inside = 0;
            for (int i = 0; i < n; ++i)
                for (int k = 0; k < n; ++k)
                    if (s + gu * ((i + 0.5) / n - 0.5) + gv * ((k + 0.5) / n - 0.5) > 0.0) ++inside;
            EXPECT_NEAR(coverage(static_cast<float>(s)), inside / static_cast<double>(n * n), 0.003)
                << angle << " " << s;
        }
    }
}

TEST(EdgeCoverage, GrowsWithTheScaleOfTheDistance) {
    const EdgeCoverage metres(0.002F, 0.001F);
    const EdgeCoverage pixels(2.0F, 1.0F);
    for (float s = -2.0F; s < 2.0F; s += 0.11F) EXPECT_NEAR(metres(0.001F * s), pixels(s), 1e-4F);
}

TEST(EdgeCoverage, WithoutSlopeIsAllOrNothing) {
    const EdgeCoverage none(0.0F, 0.0F);
    EXPECT_EQ(none(0.1F), 1.0F);
    EXPECT_EQ(none(-0.1F), 0.0F);
}

TEST(StripCoverage, OfAThinStripIsItsWidth) {
    const EdgeCoverage edge(1.0F, 0.0F);
    EXPECT_NEAR(strip_coverage(edge(0.1F), edge(0.05F)), 0.15F, 1e-6F);
    EXPECT_EQ(strip_coverage(edge(-3.0F), edge(4.0F)), 0.0F);
}

TEST(EdgeCoverage, OfARampIsItsMeanOverThePixel) {
    for (const double angle : {0.0, 0.3, 0.7853981633974483, 1.4, 2.5}) {
        const double gu = std::cos(angle);
        const double gv = std::sin(angle);
        const EdgeCoverage coverage(static_cast<float>(gu), static_cast<float>(gv));
        for (const double width : {0.004, 0.05, 0.4, 1.0, 5.0})
            for (double s = -3.5; s <= 3.5; s += 0.23) {
                constexpr int n = 200;
                double sum = 0.0;
                for (int i = 0; i < n; ++i)
                    for (int k = 0; k < n; ++k)
                        sum += std::clamp(
                            0.5 + (s + gu * ((i + 0.5) / n - 0.5) + gv * ((k + 0.5) / n - 0.5)) / width, 0.0,
                            1.0);
                EXPECT_NEAR(coverage.ramp(static_cast<float>(s), static_cast<float>(width)), sum / (n * n),
                            0.003)
                    << angle << " " << width << " " << s;
            }
    }
}

}  // namespace
}  // namespace goalmouth
