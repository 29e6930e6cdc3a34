#include "core/evaluation/visible_post.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

const Intrinsics camera;  // 640×480 without distortion

std::array<EdgePath, 2> straight(double left, double right, double top, double base) {
    return {bent_edge(camera, {left, top}, {left, base}), bent_edge(camera, {right, top}, {right, base})};
}

TruePost seen(double inside = 1.0, double visible = 1.0) {
    TruePost post;
    post.inside = inside;
    post.visible = visible;
    return post;
}

TEST(VisiblePost, IsCutAtTheFirstAndLastRow) {
    const auto outline = visible_outline(seen(), straight(300, 320, -100, 900), camera, {});
    ASSERT_TRUE(outline);
    EXPECT_DOUBLE_EQ(outline->left_top.y(), -0.5);
    EXPECT_DOUBLE_EQ(outline->right_base.y(), 479.5);
    EXPECT_DOUBLE_EQ(outline->left_top.x(), 300.0);
    EXPECT_TRUE(outline->counts);
}

TEST(VisiblePost, CountsWhereHalfItsRowsLieWithinThePicturesWidth) {
    // Leans out of the picture to the left: its left edge crosses x = −0.5 at a share of the rows.
    const auto leaning = [](double top_x) {
        return std::array{bent_edge(camera, {top_x, 100}, {40.0, 300}),
                          bent_edge(camera, {top_x + 20, 100}, {60.0, 300})};
    };
    const auto mostly = visible_outline(seen(), leaning(-30.0), camera, {});
    ASSERT_TRUE(mostly);
    EXPECT_TRUE(mostly->counts) << "40.5 of 70 px across";
    const auto barely = visible_outline(seen(), leaning(-50.0), camera, {});
    ASSERT_TRUE(barely);
    EXPECT_FALSE(barely->counts) << "40.5 of 90";
    EXPECT_GT(barely->right_top.y(), 100.0) << "rows without any of it are cut off";
    EXPECT_NEAR(barely->right_top.x(), -0.5, 0.5);
    EXPECT_TRUE(visible_outline(seen(), leaning(-50.0), camera, {.least_inside = 0.4})->counts);
}

TEST(VisiblePost, DoesNotCountWhereMoreIsHiddenThanAllowed) {
    const auto edges = straight(300, 320, 100, 300);
    EXPECT_TRUE(visible_outline(seen(0.5, 0.31), edges, camera, {})->counts);
    EXPECT_FALSE(visible_outline(seen(0.5, 0.29), edges, camera, {})->counts);
    EXPECT_FALSE(visible_outline(seen(0.0, 0.0), edges, camera, {})->counts);
}

TEST(VisiblePost, IsNothingBesideOrAboveThePicture) {
    EXPECT_FALSE(visible_outline(seen(), straight(-40, -20, 100, 300), camera, {}));
    EXPECT_FALSE(visible_outline(seen(), straight(700, 720, 100, 300), camera, {}));
    EXPECT_FALSE(visible_outline(seen(), straight(300, 320, -300, -10), camera, {}));
    EXPECT_TRUE(visible_outline(seen(), straight(-40, 20, 100, 300), camera, {}));
}

TEST(VisiblePost, HasTheBearingOfItsMiddleInARow) {
    const auto outline = visible_outline(seen(), straight(419.5, 439.5, 100, 300), camera, {});
    EXPECT_NEAR(bearing_in_row(*outline, camera, 200.0), -std::atan(110.0 / camera.fx), 1e-12);
}

TEST(EdgePath, FollowsTheLens) {
    Intrinsics lens = camera;
    lens.distortion = {-0.2, 0.0, 0.0, 0.0, 0.0};
    const EdgePath edge = bent_edge(lens, {500, 40}, {520, 460});
    for (const double share : {0.0, 0.3, 0.5, 0.9, 1.0}) {
        const Eigen::Vector2d undistorted =
            (1.0 - share) * Eigen::Vector2d(500, 40) + share * Eigen::Vector2d(520, 460);
        const Eigen::Vector2d bent = pixel_from_normalised(
            lens, {(undistorted.x() - lens.cx) / lens.fx, (undistorted.y() - lens.cy) / lens.fy});
        EXPECT_NEAR(edge.x_at(bent.y()), bent.x(), 1e-3);
    }
    EXPECT_LT(edge.x_at(240.0), 506.0) << "barrel distortion draws it inwards";
}

TEST(EdgePath, StopsWhereTheLensModelFolds) {
    Intrinsics lens = camera;
    lens.distortion = {-0.5, 0.0, 0.0, 0.0, 0.0};  // folds at a radius of 0.82
    const EdgePath edge = bent_edge(lens, {330, -5000}, {330, 400});
    ASSERT_FALSE(edge.empty());
    EXPECT_LT(edge.top(), -0.5 + 240.0 - 554.26 * 0.54);
    EXPECT_GT(edge.top(), 239.5 - 554.26 * 0.55);
    for (double row = edge.top(); row < edge.base(); row += 5.0) EXPECT_NEAR(edge.x_at(row), 330.0, 8.0);
}

CameraMotion still_camera() {
    CameraMotion motion;
    motion.T_WC = camera_in_body(0.42, 0.2, 0.05);
    return motion;
}

Cylinder post_ahead() {
    Cylinder post;
    post.base = {2.0, 0.1, 0.0};
    post.length = 0.95;
    return post;
}

TEST(EdgePath, OfAStillCameraIsTheProjection) {
    const CameraMotion motion = still_camera();
    const auto expected = project_edges(camera, motion.T_WC, post_ahead());
    for (const double readout : {0.0, 0.03}) {
        const auto edges = edges_in_picture(camera, motion, {.readout = readout}, post_ahead());
        EXPECT_NEAR(edges[0].top(), expected->left_top.y(), 1e-9);
        EXPECT_NEAR(edges[0].at(edges[0].top()).x(), expected->left_top.x(), 1e-9);
        EXPECT_NEAR(edges[1].base(), expected->right_base.y(), 1e-9);
    }
}

TEST(EdgePath, LeansWithARollingShutter) {
    CameraMotion motion;
    motion.T_WC = camera_in_body(0.42, 0.0, 0.0);
    motion.turn_rate = {0.0, 0.5, 0.0};  // to the right: what is seen moves to the left
    Cylinder post = post_ahead();
    post.base.y() = 0.0;
    const double readout = 0.04;
    const auto edges = edges_in_picture(camera, motion, {.readout = readout}, post);
    const auto still = edges_in_picture(camera, motion, {.readout = 0.0}, post);
    for (const double row : {200.0, 239.5, 330.0}) {
        const double angle = 0.5 * readout * (row / 479.0 - 0.5);
        const double expected = still[0].x_at(row) - camera.fx * angle;
        EXPECT_NEAR(edges[0].x_at(row), expected, 0.01) << row;
    }
    EXPECT_NEAR(edges[0].top(), still[0].top(), 0.1);
    EXPECT_NEAR(edges[0].base(), still[0].base(), 0.1);
}

TEST(EdgePath, StretchesWithAShutterThatRollsAlong) {
    CameraMotion motion;
    motion.T_WC = camera_in_body(0.42, 0.0, 0.0);
    motion.turn_rate = {1.0, 0.0, 0.0};  // upwards: what is seen moves down, and rows are read downwards
    Cylinder post = post_ahead();
    const double readout = 0.04;
    const auto still = edges_in_picture(camera, motion, {.readout = 0.0}, post);
    const auto rolled = edges_in_picture(camera, motion, {.readout = readout}, post);
    const double rate = camera.fx * 1.0 * readout / 479.0;  // px moved a row, near the axis
    EXPECT_NEAR((rolled[0].base() - rolled[0].top()) / (still[0].base() - still[0].top()), 1.0 / (1.0 - rate),
                0.01);
}

}  // namespace
}  // namespace goalmouth
