#include "core/detection/upright_pairs.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr UprightSize size{0.05, 0.95};
constexpr UprightDoubt doubt{0.0175, 2.0 / 554.0, 1.0 / 554.0};
constexpr double goal_width = 1.5;

UprightPairs pairs() {
    return UprightPairs(size, goal_width, 0.03);
}

/// A post of that distance and direction, seen from top to base.
UprightPost post(double distance, double azimuth, double score, double roll = 0.0) {
    UprightPost p;
    const double half = std::asin(size.radius / distance);
    p.edges = {azimuth - half, azimuth + half, roll};
    p.evidence.score = score;
    p.evidence.first_slope = 0.5 / distance;
    p.evidence.last_slope = -0.4 / distance;
    return p;
}

/// Of a goal straight ahead.
double half_goal(double distance) {
    return std::asin(0.5 * goal_width / distance);
}

TEST(UprightPairs, OfTwoInOnePlaceTheOneThatLeansAsTheOtherPostDoes) {
    // Leans of one's own differ little, whatever the camera's error.
    const std::vector<UprightPost> posts = {post(4.0, -0.3, 44.0, 0.03), post(4.0, 0.05, 30.0, -0.05),
                                            post(4.0, 0.055, 26.0, 0.03)};
    const auto best = pairs().best(posts, doubt);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->first, 0U);
    EXPECT_EQ(best->second, 2U);
}

TEST(UprightPairs, AVerticalThatIsHardlyKnownExplainsLeansThatDifferFarApart) {
    const std::vector<UprightPost> posts = {post(2.0, -0.4, 44.0, 0.03), post(2.0, 0.4, 30.0, -0.05),
                                            post(2.0, 0.405, 29.0, 0.03)};
    UprightDoubt unknown = doubt;
    unknown.attitude_sigma = 0.26;
    const auto best = pairs().best(posts, unknown);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->second, 1U);
}

TEST(UprightPairs, OfTwoWidthsTheOneThatMakesAGoal) {
    const double half = half_goal(6.0);
    const std::vector<UprightPost> posts = {post(6.0, -half, 40.0), post(3.9, half - 0.002, 38.0),
                                            post(6.0, half, 33.0)};
    const auto best = pairs().best(posts, doubt);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->first, 0U);
    EXPECT_EQ(best->second, 2U);
    const UprightPairs wide(size, 4.0, 0.03);
    EXPECT_EQ(wide.best(posts, doubt)->second, 1U) << "another goal";
}

TEST(UprightPairs, TwoInOnePlaceAreNone) {
    const std::vector<UprightPost> posts = {post(3.0, 0.0, 40.0), post(3.1, 0.001, 39.0)};
    EXPECT_FALSE(pairs().best(posts, doubt));
    EXPECT_FALSE(pairs().best({}, doubt));
    EXPECT_FALSE(pairs().best({posts.data(), 1}, doubt));
}

TEST(UprightPairs, WhatIsAtOddsWithTheBestAloneIsLeft) {
    // It would cost more than it brings.
    const std::vector<UprightPost> posts = {post(3.0, -0.2, 60.0, 0.0), post(5.0, 0.1, 8.0, 0.09)};
    EXPECT_FALSE(pairs().best(posts, doubt));
}

}  // namespace
}  // namespace goalmouth
