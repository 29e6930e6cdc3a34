#include "core/localisation/pose_candidates.h"

#include "tests/core/localisation/world.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::heading_error;
using test::position_error;
using test::Walker;

TEST(PoseFromPair, IsExactForExactMeasurements) {
    const Field field;
    const auto posts = field.posts();
    Random random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const Pose2 truth{random.uniform(-2.8, 2.8), random.uniform(-2, 2), random.uniform(-3, 3)};
        const Eigen::Vector2d camera(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
        const std::size_t k = random.index(4);
        const std::size_t l = (k + 1 + random.index(3)) % 4;
        const Eigen::Vector2d d1 = inverse_transform(truth, posts[k]) - camera;
        const Eigen::Vector2d d2 = inverse_transform(truth, posts[l]) - camera;
        if (d1.norm() < 0.1 || d2.norm() < 0.1) continue;
        const auto found = pose_from_pair(posts[k], posts[l], camera, std::atan2(d1.y(), d1.x()), d1.norm(),
                                          std::atan2(d2.y(), d2.x()), d2.norm());
        // Where the sight line to the second touches the circle of d1 the two roots meet, and rounding may
        // leave none.
        if (!found) continue;
        EXPECT_NEAR(found->second_distance, d2.norm(), 1e-4);
        EXPECT_LT(position_error(found->pose, truth), 1e-4);
        EXPECT_LT(heading_error(found->pose, truth), 1e-4);
    }
}

TEST(PoseFromPair, ThereIsNoneForAnAngleThatCannotBe) {
    EXPECT_FALSE(pose_from_pair({3, 0.75}, {3, -0.75}, {0, 0}, 0.0, 5.0, 1.0, 5.0));
}

TEST(DrawPose, DrawsFromAPairLieAtTheTruthItsMirrorImageOrAnotherPlaceThatFits) {
    const Field field;
    const SensorModel model(field, {});
    Random random(2);
    Walker walker(field, {0.6, 0.7, -0.2}, 3);
    const FrameObservation frame = walker.look(walker.goal_azimuth(), 0.6, 1.0, {0.005, 0.02, 0.0});
    ASSERT_EQ(frame.posts.size(), 2U);
    int drawn = 0;
    int right = 0;
    int mirror = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto pose = draw_pose(frame, model, random);
        if (!pose) continue;
        ++drawn;
        right += position_error(*pose, walker.pose()) < 0.5 && heading_error(*pose, walker.pose()) < 0.3;
        const Pose2 other = mirrored(*pose);
        mirror += position_error(other, walker.pose()) < 0.5 && heading_error(other, walker.pose()) < 0.3;
    }
    EXPECT_GT(drawn, 900);
    EXPECT_GT(right, drawn / 3);
    EXPECT_GT(mirror, drawn / 3);
}

TEST(DrawPose, OnePostGivesPosesOnACircleThatSeeIt) {
    const Field field;
    const SensorModel model(field, {});
    Random random(3);
    FrameObservation frame;
    frame.camera = {0.05, 0.0};
    PostObservation z;
    z.azimuth = 0.3;
    z.has_distance = true;
    z.inverse_distance = 0.5;
    z.covariance << 1e-6, 0, 0, 1e-6;
    frame.posts = {z};
    for (int i = 0; i < 300; ++i) {
        const auto pose = draw_pose(frame, model, random);
        if (!pose) continue;
        EXPECT_GT(model.log_place(*pose), -20.0);
        double best = 1e9;
        for (const Eigen::Vector2d& post : field.posts()) {
            const Eigen::Vector2d d = inverse_transform(*pose, post) - frame.camera;
            best = std::min(best,
                            std::abs(d.norm() - 2.0) + std::abs(wrap_angle(std::atan2(d.y(), d.x()) - 0.3)));
        }
        EXPECT_LT(best, 0.05);
    }
}

TEST(DrawPose, NothingFromNothing) {
    const SensorModel model(Field{}, {});
    Random random(4);
    EXPECT_FALSE(draw_pose({}, model, random));
}

TEST(Mirrored, TwiceIsTheSame) {
    const Pose2 pose{1.0, -0.4, 2.0};
    const Pose2 twice = mirrored(mirrored(pose));
    EXPECT_NEAR(twice.x, pose.x, 1e-12);
    EXPECT_NEAR(wrap_angle(twice.theta - pose.theta), 0.0, 1e-12);
}

}  // namespace
}  // namespace goalmouth
