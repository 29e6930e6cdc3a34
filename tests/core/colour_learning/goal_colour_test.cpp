#include "core/colour_learning/goal_colour.h"

#include "core/imaging/conversion.h"

#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace goalmouth {
namespace {

const Eigen::Vector3d yellow(226, 184, 34);

/// A post of some colour in a grey picture, and a table that calls yellow goal.
struct View {
    explicit View(const Eigen::Vector3d& rgb) {
        cv::Mat bgr(240, 320, CV_8UC3, cv::Scalar(150, 158, 160));
        bgr(cv::Rect(100, 40, 20, 160)).setTo(cv::Scalar(rgb.z(), rgb.y(), rgb.x()));
        image = yuyv_from_bgr(bgr);
        table.set(ycbcr_from_bgr(cv::Vec3b(34, 184, 226)), Colour::goal);
        post.left_top = {99.5, 40.0};
        post.left_base = {99.5, 200.0};
        post.right_top = {119.5, 40.0};
        post.right_base = {119.5, 200.0};
    }
    YuyvImage image;
    ColourTable table{6};
    Post post;
};

TEST(PostColours, AreThoseBetweenBothEdges) {
    View view(yellow);
    const auto colours = post_colours(view.image.view(), std::vector{view.post}, view.table);
    ASSERT_EQ(colours.size(), 1U);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(colours[0][c], yellow[c], 1.5) << c;
}

TEST(PostColours, NeedBothEdgesAndThePostsColour) {
    View view(yellow);
    Post one_edge = view.post;
    one_edge.flags = post_flag::left_edge_missing;
    Post elsewhere = view.post;
    for (Eigen::Vector2d* corner :
         {&elsewhere.left_top, &elsewhere.left_base, &elsewhere.right_top, &elsewhere.right_base})
        corner->x() += 12.0;
    Post outside = view.post;
    for (Eigen::Vector2d* corner :
         {&outside.left_top, &outside.left_base, &outside.right_top, &outside.right_base})
        *corner += Eigen::Vector2d(400.0, -900.0);
    std::vector<Post> none = {one_edge, elsewhere, outside};
    for (const Eigen::Vector2d& far : {Eigen::Vector2d(0.0, 3e9), Eigen::Vector2d(0.0, -3e9),
                                       Eigen::Vector2d(3e9, 0.0), Eigen::Vector2d(-3e9, 0.0)}) {
        Post beyond = view.post;
        for (Eigen::Vector2d* corner :
             {&beyond.left_top, &beyond.left_base, &beyond.right_top, &beyond.right_base})
            *corner += far;
        none.push_back(beyond);
        beyond.left_top = beyond.right_top = view.post.left_top;
        none.push_back(beyond);
    }
    EXPECT_TRUE(post_colours(view.image.view(), none, view.table).empty());
    EXPECT_TRUE(post_colours(View({60, 80, 160}).image.view(), std::vector{view.post}, view.table).empty());
}

TEST(GoalColour, IsTheMedianOfPostsWithoutTheGains) {
    GoalColour colour({});
    for (int i = 0; i < 9; ++i) colour.see(0.8 * yellow, {0.8, 0.8, 0.8});
    EXPECT_FALSE(colour.levels());
    for (int i = 0; i < 4; ++i) colour.see({60, 80, 160}, {});  // no posts
    ASSERT_TRUE(colour.levels());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR((*colour.levels())[c], yellow[c], 1e-9) << c;
}

TEST(GoalColour, DoesNotLookInOtherLightNorAtWhatClips) {
    GoalColour colour({});
    for (int i = 0; i < 50; ++i) {
        colour.see(0.5 * yellow, {0.5, 0.5, 0.5});
        colour.see(yellow, {1.0, 1.0, 1.6});
        colour.see({255, 200, 40}, {});
    }
    EXPECT_FALSE(colour.levels());
}

TEST(GoalColour, StaysOnceEnoughWereSeen) {
    GoalColour colour({});
    for (int i = 0; i < 40; ++i) colour.see(yellow, {});
    EXPECT_TRUE(colour.complete());
    for (int i = 0; i < 100; ++i) colour.see({60, 80, 160}, {});
    EXPECT_EQ(*colour.levels(), yellow);
}

}  // namespace
}  // namespace goalmouth
