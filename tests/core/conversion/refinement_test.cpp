#include "core/conversion/refinement.h"

#include "core/messaging/validation.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

RefinedPost measured() {
    RefinedPost post;
    post.post.flags = post_flag::refined | post_flag::cut_top;
    post.quality = 0.75;
    post.rows = 50;
    post.iterations = 3;
    post.left = RefinedEdge{{0.8, 0.0, 0.6}, 45};
    post.right = RefinedEdge{{-0.6, 0.8, 0.0}, 49};
    post.base = Eigen::Vector2d(20.25, 99.5);
    post.cues = {{DistanceCueKind::width, 2.5, 0.02}, {DistanceCueKind::goal, 2.4, 0.01}};
    return post;
}

TEST(RefinementMessage, SurvivesTheWayThereAndBack) {
    RefinedPost unmeasured;
    unmeasured.reason = "no picture";
    const refinement_t m = to_message(std::vector{measured(), unmeasured}, 5, 6);
    ASSERT_EQ(problem(m), std::nullopt);
    EXPECT_EQ(m.utime, 5);
    EXPECT_EQ(m.seq, 6);

    const auto back = from_message(m);
    ASSERT_EQ(back.size(), 2U);
    const RefinedPost& post = back[0];
    const RefinedPost sent = measured();
    EXPECT_TRUE(post.post.has(post_flag::refined));
    EXPECT_EQ(post.reason, "");
    EXPECT_EQ(post.quality, sent.quality);
    EXPECT_EQ(post.rows, sent.rows);
    EXPECT_EQ(post.iterations, sent.iterations);
    ASSERT_TRUE(post.left && post.right && post.base);
    EXPECT_EQ(post.left->plane, sent.left->plane);
    EXPECT_EQ(post.left->rows, sent.left->rows);
    EXPECT_EQ(post.right->plane, sent.right->plane);
    EXPECT_EQ(post.right->rows, sent.right->rows);
    EXPECT_EQ(*post.base, *sent.base);
    EXPECT_FALSE(post.top);
    ASSERT_EQ(post.cues.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(post.cues[i].kind, sent.cues[i].kind);
        EXPECT_EQ(post.cues[i].distance, sent.cues[i].distance);
        EXPECT_EQ(post.cues[i].sigma, sent.cues[i].sigma);
    }
    EXPECT_FALSE(back[1].post.has(post_flag::refined));
    EXPECT_EQ(back[1].reason, "no picture");
    EXPECT_FALSE(back[1].left || back[1].right || back[1].base || back[1].top);
    EXPECT_TRUE(back[1].cues.empty());
}

TEST(RefinementMessage, OneEdgeAloneHasNoPlaneForTheOther) {
    RefinedPost post = measured();
    post.right.reset();
    post.base.reset();
    post.top = Eigen::Vector2d(7, -3);
    const refined_post_t m = to_message(post);
    EXPECT_EQ(problem(m), std::nullopt);
    EXPECT_EQ(m.rows_right, 0);
    for (const double v : m.right_plane) EXPECT_EQ(v, 0.0);
    const RefinedPost back = from_message(m);
    EXPECT_TRUE(back.left);
    EXPECT_FALSE(back.right);
    EXPECT_FALSE(back.base);
    EXPECT_EQ(back.top, post.top);
}

TEST(RefinementMessage, PostsOfAreThePosts) {
    const auto posts = posts_of({measured(), RefinedPost{}});
    ASSERT_EQ(posts.size(), 2U);
    EXPECT_EQ(posts[0].flags, measured().post.flags);
    EXPECT_EQ(posts[1].flags, 0U);
    EXPECT_EQ(problem(to_message(std::vector<RefinedPost>{}, 1, 2)), std::nullopt);
}

}  // namespace
}  // namespace goalmouth
