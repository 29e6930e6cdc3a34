#include "core/localisation/regularisation.h"

#include "tests/core/localisation/world.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

PostObservation refined_observation(double azimuth, double distance) {
    PostObservation z;
    z.refined = true;
    z.azimuth = azimuth;
    z.has_distance = true;
    z.inverse_distance = 1.0 / distance;
    z.common_azimuth_variance = 1e-5;
    z.covariance << 2e-5, 0, 0, 1e-7;
    return z;
}

PoseHypothesis belief_with(double x, double y, double theta) {
    PoseHypothesis belief;
    belief.pose = {-1.0, 0.5, 0.7};
    belief.covariance.diagonal() << x * x, y * y, theta * theta;
    return belief;
}

TEST(Regularisation, KernelsShrinkWithTheNumberOfParticles) {
    EXPECT_NEAR(kernel_share(400), std::pow(0.002, 2.0 / 7.0), 1e-12);
    EXPECT_LT(kernel_share(4000), kernel_share(400));
}

TEST(Regularisation, ObservationsThatAreNotRefinedAreLeftAsTheyAre) {
    FrameObservation frame;
    frame.posts = {refined_observation(0.2, 2.0)};
    frame.posts[0].refined = false;
    const FrameObservation result = widened(frame, belief_with(0.5, 0.5, 0.2), 0.2);
    EXPECT_EQ(result.posts[0].covariance, frame.posts[0].covariance);
    EXPECT_EQ(result.posts[0].common_azimuth_variance, frame.posts[0].common_azimuth_variance);
}

TEST(Regularisation, WhatAKernelSpansIsAdded) {
    // Monte Carlo: a post's azimuth and inverse distance as poses drawn from the kernel expect them.
    const Field field;
    const PoseHypothesis belief = belief_with(0.1, 0.05, 0.04);
    constexpr double share = 0.2;
    const Eigen::Vector2d post = field.posts()[2];
    const auto expected = [&](const Pose2& pose) {
        const Eigen::Vector2d d = post - pose.position();
        return Eigen::Vector2d(wrap_angle(std::atan2(d.y(), d.x()) - pose.theta), 1.0 / d.norm());
    };
    const Eigen::Vector2d middle = expected(belief.pose);
    FrameObservation frame;
    frame.posts = {refined_observation(middle[0], 1.0 / middle[1])};
    const PostObservation z = widened(frame, belief, share).posts[0];
    const Eigen::Matrix2d added = z.covariance - frame.posts[0].covariance;

    Random random(1);
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    constexpr int draws = 20000;
    const double h = std::sqrt(share);
    for (int i = 0; i < draws; ++i) {
        const Pose2 pose{belief.pose.x + h * 0.1 * random.normal(),
                         belief.pose.y + h * 0.05 * random.normal(),
                         belief.pose.theta + h * 0.04 * random.normal()};
        Eigen::Vector2d e = expected(pose) - middle;
        e[0] = wrap_angle(e[0]);
        spread += e * e.transpose() / draws;
    }
    EXPECT_NEAR(added(0, 0) / spread(0, 0), 1.0, 0.05);
    EXPECT_NEAR(added(1, 1) / spread(1, 1), 1.0, 0.05);
    EXPECT_NEAR(added(0, 1) / std::sqrt(spread(0, 0) * spread(1, 1)),
                spread(0, 1) / std::sqrt(spread(0, 0) * spread(1, 1)), 0.05);
    EXPECT_NEAR(z.common_azimuth_variance - frame.posts[0].common_azimuth_variance, share * 0.04 * 0.04,
                1e-12);
}

TEST(Regularisation, ABeliefWithoutSpreadAddsNothing) {
    FrameObservation frame;
    frame.posts = {refined_observation(0.2, 2.0)};
    const FrameObservation result = widened(frame, belief_with(0, 0, 0), 0.2);
    EXPECT_EQ(result.posts[0].covariance, frame.posts[0].covariance);
}

}  // namespace
}  // namespace goalmouth
