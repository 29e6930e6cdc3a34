#include "core/evaluation/statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(Statistics, OfFourErrorsByHand) {
    const auto s = error_statistics(std::vector{3.0, -1.0, 0.0, 6.0});
    ASSERT_TRUE(s);
    EXPECT_DOUBLE_EQ(s->bias, 2.0);
    EXPECT_DOUBLE_EQ(s->rmse, std::sqrt(46.0 / 4.0));
    EXPECT_DOUBLE_EQ(s->sigma, std::sqrt(7.5));      // deviations 1, −3, −2, 4
    EXPECT_DOUBLE_EQ(s->median_abs, 2.0);            // of 0, 1, 3, 6
    EXPECT_DOUBLE_EQ(s->p95_abs, 3.0 + 0.85 * 3.0);  // place 2.85
}

TEST(Statistics, OfOneErrorAreThatError) {
    const auto s = error_statistics(std::vector{-0.25});
    ASSERT_TRUE(s);
    EXPECT_DOUBLE_EQ(s->bias, -0.25);
    EXPECT_DOUBLE_EQ(s->rmse, 0.25);
    EXPECT_DOUBLE_EQ(s->sigma, 0.0);
    EXPECT_DOUBLE_EQ(s->median_abs, 0.25);
    EXPECT_DOUBLE_EQ(s->p95_abs, 0.25);
}

TEST(Statistics, OfNothingAreNothing) {
    EXPECT_FALSE(error_statistics({}));
    EXPECT_FALSE(percentile({}, 0.5));
}

TEST(Statistics, PercentileOfZeroToHundredIsItself) {
    std::vector<double> sample;
    for (int i = 100; i >= 0; --i) sample.push_back(i);
    for (const double share : {0.0, 0.05, 0.5, 0.95, 1.0})
        EXPECT_NEAR(*percentile(sample, share), 100.0 * share, 1e-12);
}

TEST(Statistics, SquareOfRmseIsThatOfBiasAndSpread) {
    const auto s = error_statistics(std::vector{0.1, 0.7, -2.0, 1.3, 0.2});
    EXPECT_NEAR(s->rmse * s->rmse, s->bias * s->bias + s->sigma * s->sigma, 1e-12);
}

}  // namespace
}  // namespace goalmouth
