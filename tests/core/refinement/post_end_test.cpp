#include "core/refinement/post_refiner.h"
#include "tests/core/refinement/drawn_post.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::DrawnPost;
using test::Levels;

const Levels carpet(52, 122, 62), wall(180, 182, 188);

/// Before a wall, on a carpet that ends `behind` px above the foot.
DrawnPost on_carpet() {
    DrawnPost scene;
    scene.camera.width = 160;
    scene.camera.height = 240;
    scene.camera.cx = 79.5;
    scene.camera.cy = 119.5;
    scene.distance = 3.5;
    scene.pitch = 0.02;
    scene.behind = [](double, double y) { return y > 165.0 ? carpet : wall; };
    return scene;
}

RefinedPost refine(const DrawnPost& scene) {
    RefinementParameters parameters;
    PostRefiner refiner(parameters, {});
    const YuyvImage image = scene.draw();
    return refiner.refine(image.view(), {scene.found(0.6, -0.6)}, scene.camera, scene.pose()).front();
}

/// The drawing cuts a post where the plane through its axis ends.
Eigen::Vector2d drawn_end(const DrawnPost& scene, double height) {
    const Eigen::Vector3d point = scene.cylinder().base + Eigen::Vector3d(0.0, 0.0, height);
    return *project(scene.camera, scene.T_WC().inverse() * point);
}

TEST(PostEnds, LieWhereTheColourEnds) {
    for (const double roll : {0.0, 0.2}) {
        DrawnPost scene = on_carpet();
        scene.roll = roll;
        const RefinedPost refined = refine(scene);
        ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
        ASSERT_TRUE(refined.base && refined.top);
        EXPECT_LT((*refined.base - drawn_end(scene, 0.0)).norm(), 0.2);
        EXPECT_LT((*refined.top - drawn_end(scene, scene.length)).norm(), 0.2);
    }
}

TEST(PostEnds, ShadowsAboutTheFootDoNotMoveIt) {
    DrawnPost scene = on_carpet();
    const double foot = drawn_end(scene, 0.0).y();
    const auto plain = refine(scene);
    scene.behind = [foot](double, double y) {
        if (y < 165.0) return wall;
        return y > foot + 2.0 && y < foot + 4.0 ? Levels(0.6 * carpet) : carpet;
    };
    const auto shadow = refine(scene);
    ASSERT_TRUE(plain.base && shadow.base);
    EXPECT_LT((*plain.base - *shadow.base).norm(), 0.1);
}

TEST(PostEnds, ARobotBeforeTheFootIsNoBase) {
    DrawnPost scene = on_carpet();
    const double foot = drawn_end(scene, 0.0).y();
    scene.before = [foot](double x, double y) -> std::optional<Levels> {
        if (y < foot - 25.0 || std::abs(x - 85.0) > 30.0) return std::nullopt;
        return std::abs(x - 85.0) > 12.0 ? Levels(44, 44, 48) : Levels(130, 130, 134);
    };
    const RefinedPost refined = refine(scene);
    ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
    EXPECT_FALSE(refined.base);
    for (const DistanceCue& cue : refined.cues) EXPECT_EQ(cue.kind, DistanceCueKind::width);
}

TEST(PostEnds, ThePicturesBorderIsNoEnd) {
    DrawnPost scene = on_carpet();
    scene.pitch = -0.28;  // looks up: the foot is below the picture
    scene.behind = [](double, double) { return wall; };
    const RefinedPost up = refine(scene);
    ASSERT_TRUE(up.post.has(post_flag::refined)) << up.reason;
    EXPECT_FALSE(up.base);
    scene.pitch = 0.28;
    scene.behind = [](double, double y) { return y > 20.0 ? carpet : wall; };
    const RefinedPost down = refine(scene);
    ASSERT_TRUE(down.post.has(post_flag::refined)) << down.reason;
    EXPECT_FALSE(down.top);
}

TEST(PostEnds, WhatGoesOnAboveInThePostsColourIsNoTop) {
    DrawnPost scene = on_carpet();
    const double top = drawn_end(scene, scene.length).y();
    const Levels post = scene.post;
    scene.behind = [top, post](double x, double y) {
        if (y > 165.0) return carpet;
        return std::abs(x - 79.5) < 30.0 && y > top - 5.0 && y < top + 30.0 ? post : wall;
    };
    EXPECT_FALSE(refine(scene).top);
}

TEST(PostEnds, EdgesThatRunTogetherAreNotAPostsOwn) {
    DrawnPost scene = on_carpet();
    const Eigen::Vector2d foot = drawn_end(scene, 0.0), head = drawn_end(scene, scene.length);
    const double half = scene.camera.fx * scene.radius / scene.distance;
    const Levels post = scene.post;
    // Something of its colour beside it that leans away.
    scene.behind = [=](double x, double y) {
        const double way = (foot.y() - y) / (foot.y() - head.y());
        if (way > 0.02 && way < 1.0 && x > foot.x() && x < foot.x() + half + 2.5 * way) return post;
        return y > 165.0 ? carpet : wall;
    };
    const RefinedPost refined = refine(scene);
    EXPECT_TRUE(!refined.post.has(post_flag::refined) || std::abs(refined.post.distance_m - scene.distance) <
                                                             4.0 * std::sqrt(refined.post.covariance(0, 0)))
        << refined.post.distance_m;
}

}  // namespace
}  // namespace goalmouth
