#include "core/refinement/luma_line.h"

#include "core/random/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr int width = 80, height = 120;
constexpr double left = 20.3, across = 28.0, noise = 4.0;

/// A cylinder, lit from the left, whose luma has a step [levels] at a column, and ends at its edges.
YuyvImage cylinder_with(double step, double column) {
    YuyvImage image(width, height);
    Random random(7);
    for (int y = 0; y < height; ++y) {
        std::uint8_t* row = image.data.data() + static_cast<std::ptrdiff_t>(y) * image.stride();
        for (int x = 0; x < width; ++x) {
            double sum = 0.0;
            constexpr int pieces = 40;
            for (int k = 0; k < pieces; ++k) {  // a blur of 1 px
                const double at = x + random.normal() * 0.9 + (k + 0.5) / pieces - 0.5;
                const double u = 2.0 * (at - left) / across - 1.0;
                const double post = 90.0 + 40.0 * std::sqrt(std::max(0.0, 1.0 - u * u)) - 8.0 * u;
                sum += std::abs(u) < 1.0 ? post + (at > column ? step : 0.0) : 150.0;
            }
            row[2 * x] = static_cast<std::uint8_t>(std::lround(sum / pieces + noise * random.normal()));
            row[2 * x + 1] = 128;
        }
    }
    return image;
}

std::vector<LinePoint> line_at(double x, int rows = height) {
    std::vector<LinePoint> points;
    for (int y = 0; y < rows; ++y) points.push_back({y, x});
    return points;
}

constexpr double right = left + across;
SupposedCylinder supposed(double x) {
    return {1, right - x, across, 0.9};
}

TEST(LumaLine, IsNotInACylindersShading) {
    const YuyvImage plain = cylinder_with(0.0, 0.0);
    for (const double inside : {3.0, 4.0, 6.0, 9.0, 14.0}) {
        const double x = right - inside;
        const auto line = luma_line(plain.view(), line_at(x), supposed(x));
        ASSERT_TRUE(line) << inside;
        EXPECT_LT(line->chi2, 13.0) << inside;
    }
}

TEST(LumaLine, IsWhereLumaSteps) {
    for (const double inside : {4.0, 6.0, 9.0, 14.0}) {
        const double x = right - inside;
        const YuyvImage stepped = cylinder_with(-12.0, x);
        const auto line = luma_line(stepped.view(), line_at(x), supposed(x));
        ASSERT_TRUE(line) << inside;
        EXPECT_GT(line->chi2, 15.0) << inside;
        EXPECT_LT(line->sigma, 4.0) << inside;
    }
}

TEST(LumaLine, OfFewerRowsIsLessSure) {
    const double x = right - 8.0;
    const YuyvImage stepped = cylinder_with(-12.0, x);
    const auto all = luma_line(stepped.view(), line_at(x), supposed(x));
    const auto few = luma_line(stepped.view(), line_at(x, 12), supposed(x));
    ASSERT_TRUE(all && few);
    EXPECT_GT(few->sigma, 1.5 * all->sigma);
    EXPECT_LT(few->chi2, all->chi2);
}

TEST(LumaLine, SaysNothingWithoutRowsOrRoom) {
    const YuyvImage plain = cylinder_with(0.0, 0.0);
    EXPECT_FALSE(luma_line(plain.view(), line_at(right - 8.0, 4), supposed(right - 8.0)));
    EXPECT_FALSE(luma_line(plain.view(), line_at(right - 1.0), supposed(right - 1.0)));
    EXPECT_FALSE(luma_line(plain.view(), line_at(left + 2.0), supposed(left + 2.0)));
    EXPECT_FALSE(luma_line(plain.view(), line_at(width + 30.0), supposed(right - 8.0)));
}

}  // namespace
}  // namespace goalmouth
