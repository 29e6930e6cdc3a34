#include "core/geometry/pose2.h"

#include "core/random/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr double pi = std::numbers::pi;

Pose2 random_pose(Random& random) {
    return {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-pi, pi)};
}

void expect_same(const Pose2& a, const Pose2& b) {
    EXPECT_NEAR(a.x, b.x, 1e-12);
    EXPECT_NEAR(a.y, b.y, 1e-12);
    EXPECT_NEAR(wrap_angle(a.theta - b.theta), 0.0, 1e-12);
}

TEST(WrapAngle, StaysInItsHalfOpenInterval) {
    EXPECT_DOUBLE_EQ(wrap_angle(pi), -pi);
    EXPECT_DOUBLE_EQ(wrap_angle(-pi), -pi);
    EXPECT_NEAR(wrap_angle(3.0 * pi), -pi, 1e-12);
    for (double a = -50.0; a < 50.0; a += 0.0137) {
        const double w = wrap_angle(a);
        ASSERT_GE(w, -pi);
        ASSERT_LT(w, pi);
        ASSERT_NEAR(std::cos(w), std::cos(a), 1e-12);
        ASSERT_NEAR(std::sin(w), std::sin(a), 1e-12);
    }
}

TEST(Pose2, ComposesAsWalkingDoes) {
    // One metre ahead, a turn to the left, one metre ahead.
    const Pose2 corner = compose({0, 0, 0}, {1, 0, pi / 2});
    expect_same(compose(corner, {1, 0, 0}), {1, 1, pi / 2});
}

TEST(Pose2, DifferenceUndoesCompose) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Pose2 a = random_pose(random);
        const Pose2 b = random_pose(random);
        const Pose2 c = random_pose(random);
        expect_same(compose(a, difference(a, b)), b);
        expect_same(difference(a, compose(a, b)), b);
        expect_same(compose(compose(a, b), c), compose(a, compose(b, c)));
    }
}

TEST(Pose2, TransformsPointsThereAndBack) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Pose2 a = random_pose(random);
        const Pose2 b = random_pose(random);
        const Eigen::Vector2d p(random.uniform(-3, 3), random.uniform(-3, 3));
        EXPECT_LT((inverse_transform(a, transform(a, p)) - p).norm(), 1e-12);
        EXPECT_LT((transform(a, transform(b, p)) - transform(compose(a, b), p)).norm(), 1e-12);
    }
    EXPECT_LT((transform({1, 2, pi / 2}, {1, 0}) - Eigen::Vector2d(1, 3)).norm(), 1e-12);
}

TEST(Pose2, InterpolatesTheShortWayRound) {
    const Pose2 a{0, 0, 3.0};
    const Pose2 b{2, 4, -3.0};
    expect_same(interpolate(a, b, 0.0), a);
    expect_same(interpolate(a, b, 1.0), b);
    expect_same(interpolate(a, b, 0.5), {1, 2, pi});
}

TEST(Pose2, OnTheGroundIsTheSamePoseUpright) {
    const Pose2 pose{1.0, -2.0, 0.7};
    const Eigen::Isometry3d T = on_ground(pose);
    const Eigen::Vector2d p(0.3, 0.4);
    const Eigen::Vector3d moved = T * Eigen::Vector3d(p.x(), p.y(), 0.25);
    EXPECT_LT((moved.head<2>() - transform(pose, p)).norm(), 1e-12);
    EXPECT_NEAR(moved.z(), 0.25, 1e-12);
}

}  // namespace
}  // namespace goalmouth
