#include "core/detection/upright_detector.h"

#include "core/geometry/cylinder.h"
#include "core/random/random.h"
#include "tests/core/detection/upright_scene.h"
#include "tests/support/allocations.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

/// Camera to axis along the ground.
double distance_of(const Robot& robot, const Cylinder& post) {
    return (post.base - robot.T_BC().translation()).head<2>().norm();
}

/// Bearing in frame C of the post's axis in the row half-way down what was found of it.
double bearing_in(const Robot& robot, const Cylinder& post, const Post& found) {
    const double row = 0.25 * (found.left_top + found.left_base + found.right_top + found.right_base).y();
    double nearest = 1e9, bearing = 0.0;
    for (double z = 0.0; z < 0.95; z += 0.001) {
        const Eigen::Vector3d at = robot.T_BC().inverse() * (post.base + z * post.axis);
        const auto pixel = project(robot.camera, at);
        if (!pixel || std::abs(pixel->y() - row) > nearest) continue;
        nearest = std::abs(pixel->y() - row);
        bearing = -std::atan(at.x() / at.z());
    }
    return bearing;
}

TEST(UprightDetector, MeasuresPostsAtAnyDistanceAndTilt) {
    for (const double distance : {0.6, 1.5, 3.0, 6.0}) {
        for (const double roll : {0.0, 10.0, -20.0}) {
            for (const double left : {0.0, 0.2}) {
                Robot robot;
                robot.roll = roll * degree;
                const Cylinder post = post_at(distance, left * distance);
                Candidates c = empty_frame(robot.camera);
                add(c, robot, post);
                const auto posts = detect(c, robot, robot.told(0.01, -0.015));
                ASSERT_EQ(posts.size(), 1U) << distance << " m, " << roll;
                EXPECT_NEAR(posts[0].distance_m, distance_of(robot, post), 0.01 * distance);
                EXPECT_NEAR(posts[0].bearing_rad, bearing_in(robot, post, posts[0]), 0.01);
            }
        }
    }
}

TEST(UprightDetector, LeansAsTheVerticalWasMeasured) {
    // What hides the post's right edge leans into it: the edges that most rows show lean by five degrees.
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(5.0, 0.0),
        [](Row& row, double from_top) { row.right -= std::max(0.0, from_top - 0.35) * 9.0; });
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    const double lean =
        (posts[0].left_top - posts[0].left_base).x() / (posts[0].left_base - posts[0].left_top).y();
    EXPECT_NEAR(lean, 0.0, 0.03);
}

TEST(UprightDetector, TellsLeftFromRightOfAGoalAndLeavesItsCrossbar) {
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(4.0, 0.75));
    add(c, robot, post_at(4.0, -0.75));
    Cylinder crossbar{{4.0, 0.75, 0.9}, -Eigen::Vector3d::UnitY(), 1.5, 0.05};
    for (int y = 2; y < c.height; y += spacing) {
        const double slope = (239.5 - y) / robot.camera.fy - std::tan(robot.pitch);
        if (std::abs(slope - (crossbar.base.z() - robot.height) / 4.0) > 0.05 / 4.0) continue;
        c.segments.push_back({Orientation::horizontal, y, 210, 425});
    }
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 2U);
    EXPECT_EQ(posts[0].side, PostSide::left);
    EXPECT_EQ(posts[1].side, PostSide::right);
    for (const Post& post : posts) EXPECT_NEAR(post.distance_m, std::hypot(4.0, 0.75), 0.05);
}

TEST(UprightDetector, NeedsNoPose) {
    for (const double roll : {0.0, 15.0, -15.0}) {
        Robot robot;
        robot.roll = roll * degree;
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post_at(2.5, 0.6));
        add(c, robot, post_at(2.5, -0.9));
        const auto posts = detect(c, robot, std::nullopt);
        ASSERT_EQ(posts.size(), 2U) << roll;
        EXPECT_NEAR(posts[0].distance_m, std::hypot(2.5, 0.6), 0.1);
        EXPECT_NEAR(posts[1].distance_m, std::hypot(2.5, 0.9), 0.1);
    }
}

TEST(UprightDetector, FollowsALens) {
    Robot robot;
    robot.camera.distortion = {-0.2, 0.05, 0.0, 0.0, 0.0};
    const Cylinder post = post_at(2.0, 0.8);
    Robot plain;
    Candidates drawn = empty_frame(plain.camera);
    add(drawn, plain, post);
    Candidates c = empty_frame(robot.camera);
    for (std::size_t i = 0; i < drawn.left_edges.size(); ++i) {
        // Rows of the bent picture: where its own scan-lines meet the bent edges.
        const auto bent = [&](const Eigen::Vector2d& p) {
            return pixel_from_normalised(robot.camera, normalised_from_pixel(plain.camera, p));
        };
        const Eigen::Vector2d l = bent(drawn.left_edges[i]), r = bent(drawn.right_edges[i]);
        const int y = static_cast<int>(std::lround(l.y()));
        c.segments.push_back(
            {Orientation::horizontal, y, static_cast<int>(std::ceil(l.x())), static_cast<int>(r.x())});
        c.left_edges.emplace_back(l.x(), y);
        c.right_edges.emplace_back(r.x(), y);
    }
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_NEAR(posts[0].distance_m, std::hypot(2.0, 0.8), 0.05);
}

TEST(UprightDetector, ReportsAPostThatTheBorderCuts) {
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(1.5, -0.87));
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_TRUE(posts[0].has(post_flag::right_edge_missing));
    EXPECT_TRUE(posts[0].has(post_flag::no_distance));
}

TEST(UprightDetector, FindsNothingInNothingAndNoise) {
    Robot robot;
    EXPECT_TRUE(detect(Candidates{}, robot, robot.told()).empty());
    EXPECT_TRUE(detect(empty_frame(robot.camera), robot, std::nullopt).empty());
    Random random(3);
    for (int frame = 0; frame < 20; ++frame) {
        Candidates c = empty_frame(robot.camera);
        for (int y = 2; y < c.height; y += spacing) {
            const int at = static_cast<int>(random.index(600));
            const int length = 4 + static_cast<int>(random.index(30));
            c.segments.push_back({Orientation::horizontal, y, at, at + length});
            c.left_edges.emplace_back(at - 0.5, y);
            c.right_edges.emplace_back(at + length + 0.5, y);
        }
        EXPECT_TRUE(detect(c, robot, robot.told()).empty()) << frame;
    }
}

TEST(UprightDetector, BearsLensesThatFoldBackAndNumbersWithoutMeasure) {
    Robot robot;
    robot.camera.fx = robot.camera.fy = 300.0;
    Candidates c = empty_frame(robot.camera);
    for (int y = 2; y < c.height; y += spacing) {
        for (int x = 5; x < 600; x += 90) {
            c.segments.push_back({Orientation::horizontal, y, x, x + 20});
            c.left_edges.emplace_back(x - 0.5, y);
            c.right_edges.emplace_back(x + 20.5, y);
        }
    }
    for (const double k1 : {-0.4, -3.0, 1e300}) {
        robot.camera.distortion = {k1, 0.0, 0.0, 0.0, 0.0};
        for (const Post& post : detect(c, robot, robot.told())) EXPECT_TRUE(post.left_top.allFinite()) << k1;
    }
    robot.camera.distortion = {};
    robot.camera.cx = 1e308;
    robot.camera.fx = 0.1;
    detect(c, robot, robot.told());
    robot.camera = {};
    robot.camera.fx = robot.camera.fy = 1e-3;
    CameraPose pose = robot.told();
    pose.covariance.setZero();
    pose.T_BC.translation().z() = 1e6;
    detect(c, robot, pose);
}

TEST(UprightDetector, ManyPointsOfNoiseAreThinnedOut) {
    Robot robot;
    Random random(5);
    Candidates c = empty_frame(robot.camera);
    for (int i = 0; i < 100'000; ++i) {
        const int y = 2 + spacing * static_cast<int>(random.index(119));
        c.left_edges.emplace_back(random.uniform(0.0, 639.0), y);
        c.right_edges.emplace_back(random.uniform(0.0, 639.0), y);
    }
    const auto view = UprightView::make(robot.camera, robot.told(), 0.26);
    UprightCandidates seen;
    seen.take(c, *view);
    for (const auto* points : {&seen.left, &seen.right}) EXPECT_EQ(points->size(), 4000U);
    EXPECT_TRUE(detect(c, robot, robot.told()).empty());
}

TEST(UprightDetector, ThereIsOnePostInOnePlace) {
    // Edges of a far post before the colour of a near one, which shows its own on some rows: either would do
    // alone.
    Robot robot;
    const auto near = [](Candidates& c, const Robot& r) {
        add(c, r, post_at(2.0, 0.0),
            [](Row& row, double from_top) { row.left_edge = row.right_edge = from_top > 0.65; });
    };
    const auto far = [](Candidates& c, const Robot& r) { add(c, r, post_at(6.0, 0.0)); };
    Candidates one = empty_frame(robot.camera), other = empty_frame(robot.camera);
    near(one, robot);
    far(other, robot);
    ASSERT_EQ(detect(one, robot, robot.told()).size(), 1U);
    ASSERT_EQ(detect(other, robot, robot.told()).size(), 1U);
    Candidates both = empty_frame(robot.camera);
    near(both, robot);
    far(both, robot);
    EXPECT_EQ(detect(both, robot, robot.told()).size(), 1U);
}

TEST(UprightDetector, BearsPosesThatMakeNoSense) {
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(3.0, 0.0));
    CameraPose pose = robot.told();
    pose.T_BC.translation().z() = std::nan("");
    EXPECT_EQ(detect(c, robot, pose).size(), 1U) << "as without a pose";
    pose = robot.told();
    pose.covariance.setConstant(std::nan(""));
    EXPECT_EQ(detect(c, robot, pose).size(), 1U);
    pose = robot.told();
    pose.covariance.setZero();
    EXPECT_EQ(detect(c, robot, pose).size(), 1U) << "known exactly";
    pose.T_BC = camera_in_body(0.42, 0.0, 0.5 * std::numbers::pi);
    EXPECT_TRUE(detect(c, robot, pose).empty()) << "looks along the vertical";
}

TEST(UprightDetector, RemembersNothingAndAllocatesNothingOnceWarm) {
    Robot robot;
    UprightDetector detector({}, Field{});
    std::vector<Candidates> frames;
    for (const double distance : {0.7, 1.5, 3.0, 6.0}) {
        frames.push_back(empty_frame(robot.camera));
        add(frames.back(), robot, post_at(distance, 0.0));
        add(frames.back(), robot, post_at(distance, 0.4 * distance));
    }
    frames.push_back(empty_frame(robot.camera));
    add(frames.back(), robot, post_at(1.5, -0.87));
    for (const Candidates& c : frames) detector.detect(c, robot.camera, robot.told());
    for (const Candidates& c : frames) {
        const std::vector<Post> fresh = detect(c, robot, robot.told());
        const std::vector<Post>& again = detector.detect(c, robot.camera, robot.told());
        ASSERT_EQ(fresh.size(), again.size());
        for (std::size_t i = 0; i < fresh.size(); ++i) {
            EXPECT_EQ(fresh[i].left_top, again[i].left_top);
            EXPECT_EQ(fresh[i].distance_m, again[i].distance_m);
        }
    }
    if (!test::allocations_are_counted()) GTEST_SKIP() << "another heap than the C library's";
    const test::AllocationCount count;
    for (const Candidates& c : frames) detector.detect(c, robot.camera, robot.told());
    EXPECT_EQ(count.so_far(), 0U);
}

}  // namespace
}  // namespace goalmouth::test
