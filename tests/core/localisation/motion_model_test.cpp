#include "core/localisation/motion_model.h"

#include "core/localisation/belief.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Motion step_of(double x, double theta, double seconds) {
    Motion m;
    m.seconds = seconds;
    m.known = true;
    m.step = {x, 0, theta};
    return m;
}

TEST(MotionModel, ErrorOfAWalkDoesNotDependOnHowOftenOdometryReports) {
    const MotionParameters p;
    const MotionSigma once = motion_sigma(step_of(1.0, 0.5, 4.0), p);
    double position = 0.0;
    double heading = 0.0;
    for (int i = 0; i < 120; ++i) {
        const MotionSigma s = motion_sigma(step_of(1.0 / 120, 0.5 / 120, 4.0 / 120), p);
        position += s.position * s.position;
        heading += s.heading * s.heading;
    }
    EXPECT_NEAR(std::sqrt(position), once.position, 1e-9);
    EXPECT_NEAR(std::sqrt(heading), once.heading, 1e-9);
}

TEST(MotionModel, StatedFractionHoldsForAWalkOfTheStatedLength) {
    MotionParameters p;
    p.resting_position_noise = p.resting_heading_noise = p.drift = 0.0;
    EXPECT_NEAR(motion_sigma(step_of(1.0, 0, 1), p).position, 0.2, 1e-12);
    EXPECT_NEAR(motion_sigma(step_of(0, 1.0, 1), p).heading, 0.3, 1e-12);
    Motion told = step_of(1.0, 1.0, 1);
    told.translation_noise = 0.05;
    told.rotation_noise = 0.0;
    EXPECT_NEAR(motion_sigma(told, p).position, 0.05, 1e-12);
    EXPECT_EQ(motion_sigma(told, p).heading, 0.0);
}

TEST(MotionModel, WithoutOdometryUncertaintyGrowsWithTime) {
    const MotionParameters p;
    Motion m;
    m.seconds = 1.0;
    EXPECT_NEAR(motion_sigma(m, p).position, p.unknown_position_noise, 1e-12);
    m.seconds = 4.0;
    EXPECT_NEAR(motion_sigma(m, p).position, 2 * p.unknown_position_noise, 1e-12);
    m.seconds = -1.0;
    EXPECT_EQ(motion_sigma(m, p).position, 0.0);
}

TEST(MotionModel, MovedParticlesScatterAboutTheStatedStep) {
    const MotionParameters p;
    Random random(1);
    Particles particles(20000, {{1.0, 2.0, 0.5}, 1.0 / 20000});
    const Motion m = step_of(0.3, 0.2, 1.0);
    move_particles(particles, m, p, random);
    const PoseHypothesis got = summarise(particles);
    const Pose2 want = compose({1.0, 2.0, 0.5}, m.step);
    EXPECT_NEAR(got.pose.x, want.x, 0.005);
    EXPECT_NEAR(got.pose.y, want.y, 0.005);
    EXPECT_NEAR(got.pose.theta, want.theta, 0.005);
    EXPECT_NEAR(std::sqrt(got.covariance(2, 2)), motion_sigma(m, p).heading, 0.01);
    EXPECT_NEAR(std::sqrt(0.5 * (got.covariance(0, 0) + got.covariance(1, 1))), motion_sigma(m, p).position,
                0.01);
}

TEST(MotionModel, WhatNoRobotDoesIsAJump) {
    const MotionParameters p;
    EXPECT_FALSE(is_jump(step_of(0.01, 0.02, 1.0 / 30), p));
    EXPECT_TRUE(is_jump(step_of(2.0, 0.0, 1.0 / 30), p));
    EXPECT_TRUE(is_jump(step_of(0.0, 3.0, 1.0 / 30), p));
    EXPECT_FALSE(is_jump(step_of(2.0, 0.0, 2.0), p));
}

}  // namespace
}  // namespace goalmouth
