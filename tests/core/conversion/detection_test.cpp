#include "core/conversion/border.h"
#include "core/conversion/camera_pose.h"
#include "core/conversion/candidates.h"
#include "core/conversion/posts.h"
#include "core/messaging/validation.h"
#include "core/random/random.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(BorderMessage, SurvivesTheWayThereAndBack) {
    FieldBorder border;
    border.hull = {{0, 50}, {320, 20.5}, {639, 70}};
    border.points = {{0, 50}, {10, 60}, {320, 20.5}, {639, 70}};
    const border_t m = to_message(border, 5, 6, Intrinsics{});
    EXPECT_EQ(problem(m), std::nullopt);
    EXPECT_EQ(m.seq, 6);
    EXPECT_EQ(from_message(m).hull, border.hull);
    EXPECT_EQ(from_message(m).points, border.points);
    EXPECT_EQ(problem(to_message(FieldBorder{}, 5, 6, Intrinsics{})), std::nullopt);
}

Candidates many(int count) {
    Random random(1);
    Candidates c;
    c.width = 640;
    c.height = 480;
    for (int i = 0; i < count; ++i) {
        const int start = static_cast<int>(random.index(600));
        c.segments.push_back(
            {i % 2 ? Orientation::vertical : Orientation::horizontal, start % 480, start % 480, start % 480});
        c.field.push_back({start % 480, start, start + 20});
        c.left_edges.emplace_back(start + 0.25, start % 480);
        c.right_edges.emplace_back(start + 0.75, start % 480);
    }
    return c;
}

TEST(CandidatesMessage, SurvivesTheWayThereAndBack) {
    const Candidates candidates = many(100);
    const candidates_t m = to_message(candidates, 5, 6, Intrinsics{});
    EXPECT_EQ(problem(m), std::nullopt);
    const Candidates back = from_message(m);
    EXPECT_EQ(back.width, 640);
    EXPECT_EQ(back.left_edges, candidates.left_edges);
    EXPECT_EQ(back.right_edges, candidates.right_edges);
    ASSERT_EQ(back.segments.size(), 100U);
    ASSERT_EQ(back.field.size(), 100U);
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(back.segments[i].orientation, candidates.segments[i].orientation);
        EXPECT_EQ(back.segments[i].line, candidates.segments[i].line);
        EXPECT_EQ(back.segments[i].start, candidates.segments[i].start);
        EXPECT_EQ(back.segments[i].end, candidates.segments[i].end);
        EXPECT_EQ(back.field[i].line, candidates.field[i].line);
        EXPECT_EQ(back.field[i].start, candidates.field[i].start);
        EXPECT_EQ(back.field[i].end, candidates.field[i].end);
    }
}

TEST(CandidatesMessage, IsThinnedToOneDatagram) {
    const candidates_t m = to_message(many(20000), 5, 6, Intrinsics{});
    EXPECT_EQ(problem(m), std::nullopt);
    EXPECT_LE(m.getEncodedSize(), 60000);
    EXPECT_GE(m.getEncodedSize(), 59000);
    EXPECT_NEAR(m.num_left, m.num_segments, 1);
    EXPECT_NEAR(m.num_right, m.num_segments, 1);
    EXPECT_GT(m.left_y.back(), 0.F);
}

TEST(PostsMessage, SurvivesTheWayThereAndBack) {
    Post post;
    post.left_top = {1, 2};
    post.left_base = {3, 4};
    post.right_top = {5, 6};
    post.right_base = {7, 8};
    post.flags = post_flag::cut_top | post_flag::cut_left;
    post.side = PostSide::right;
    post.width_px = 20.5;
    post.distance_m = 2.5;
    post.bearing_rad = -0.25;
    post.covariance << 0.5, 0.01, 0.01, 0.002;
    post.support_left = 30;
    post.support_right = 40;
    const posts_t m = to_message({post}, 5, 6, Intrinsics{}, "who");
    EXPECT_EQ(problem(m), std::nullopt);
    EXPECT_EQ(m.detector, "who");
    const auto back = from_message(m);
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].left_top, post.left_top);
    EXPECT_EQ(back[0].left_base, post.left_base);
    EXPECT_EQ(back[0].right_top, post.right_top);
    EXPECT_EQ(back[0].right_base, post.right_base);
    EXPECT_EQ(back[0].flags, post.flags);
    EXPECT_EQ(back[0].side, post.side);
    EXPECT_EQ(back[0].width_px, post.width_px);
    EXPECT_EQ(back[0].distance_m, post.distance_m);
    EXPECT_EQ(back[0].bearing_rad, post.bearing_rad);
    EXPECT_EQ(back[0].covariance, post.covariance);
    EXPECT_EQ(back[0].support_left, 30);
    EXPECT_EQ(back[0].support_right, 40);
}

TEST(CameraPoseMessage, SurvivesTheWayThereAndBack) {
    const Eigen::Isometry3d T_BC = camera_in_body(0.41, 0.2, 0.3, -0.5);
    const kinematics_t m = kinematics_message(T_BC, 7, 8);
    EXPECT_EQ(problem(m), std::nullopt);
    EXPECT_EQ(m.utime, 7);
    EXPECT_TRUE(camera_pose(m).isApprox(T_BC, 1e-12));
}

}  // namespace
}  // namespace goalmouth
