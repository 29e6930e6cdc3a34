#include "core/refinement/post_refiner.h"

#include "core/random/random.h"
#include "tests/core/refinement/drawn_post.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

const Levels grey{150, 150, 155};
const Levels green{52, 122, 62};

RefinedPost refine(const DrawnPost& scene, const Post& found, bool with_pose = true) {
    PostRefiner refiner({}, {});
    const YuyvImage image = scene.draw();
    return refiner
        .refine(image.view(), {found}, scene.camera,
                with_pose ? std::optional<CameraPose>(scene.pose()) : std::nullopt)
        .front();
}

double error(const RefinedPost& refined, const DrawnPost& scene) {
    return refined.post.distance_m - scene.distance;
}

void expect_measured(const RefinedPost& refined, const DrawnPost& scene, double near) {
    ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
    ASSERT_FALSE(refined.post.has(post_flag::no_distance));
    EXPECT_NEAR(refined.post.distance_m, scene.distance, near);
    const double sigma = std::sqrt(refined.post.covariance(0, 0));
    EXPECT_GT(sigma, 0.0);
    EXPECT_LT(sigma, near);
}

TEST(PostRefiner, MeasuresToAFractionOfAPixel) {
    const DrawnPost scene = small_scene();
    const RefinedPost refined = refine(scene, scene.found(0.8, -0.7));
    expect_measured(refined, scene, 0.012);  // a pixel is 16 cm here
    EXPECT_TRUE(refined.reason.empty());
    ASSERT_TRUE(refined.left && refined.right);
    const auto truth = silhouette(scene.cylinder(), scene.T_WC());
    EXPECT_LT((refined.left->plane - truth->left_plane).norm(), 2e-3);
    EXPECT_LT((refined.right->plane - truth->right_plane).norm(), 2e-3);
    ASSERT_FALSE(refined.cues.empty());
    EXPECT_EQ(refined.cues.front().kind, DistanceCueKind::width);
    const Post exact = scene.found();
    EXPECT_NEAR(refined.post.width_px, exact.width_px, 0.15);
    EXPECT_NEAR(refined.post.left_base.y(), exact.left_base.y(), 4.0);
    EXPECT_NEAR(refined.post.bearing_rad, 0.0, 5e-4);
}

TEST(PostRefiner, ShadingAlongThePostDoesNotMatter) {
    DrawnPost scene = small_scene();
    scene.distance = 5.0;
    for (const double limb : {0.0, 0.25, 0.6}) {
        scene.limb_darkening = limb;
        expect_measured(refine(scene, scene.found()), scene, 0.05);
    }
}

TEST(PostRefiner, FarOffTheAxisThePlanesTellTheDistance) {
    DrawnPost scene;
    scene.camera.height = 200;
    scene.camera.cy = 99.5;
    scene.bearing = 0.45;
    scene.distance = 2.5;
    const RefinedPost refined = refine(scene, scene.found(1.0, -1.0));
    expect_measured(refined, scene, 0.012);
    EXPECT_NEAR(refined.post.bearing_rad, 0.45, 3e-3);
}

TEST(PostRefiner, ALeaningCameraMakesNoDifference) {
    DrawnPost scene = small_scene();
    scene.roll = 0.3;
    expect_measured(refine(scene, scene.found(0.5, 0.5)), scene, 0.012);
}

TEST(PostRefiner, WithoutAPoseItMeasuresAsWellFromALevelCamera) {
    const DrawnPost scene = small_scene();
    expect_measured(refine(scene, scene.found(), false), scene, 0.02);
}

TEST(PostRefiner, LooseOrTightStartsEndAtTheSamePlace) {
    DrawnPost scene = small_scene();
    scene.distance = 4.0;
    const YuyvImage image = scene.draw();
    RefinementParameters parameters;
    parameters.start_floor = 0.03;  // as in the whole picture that this is a quarter of
    PostRefiner refiner(parameters, {});
    const double straight =
        refiner.refine(image.view(), {scene.found()}, scene.camera, scene.pose()).front().post.distance_m;
    for (const double wider : {-3.0, -1.5, 1.5, 4.0}) {
        const RefinedPost refined =
            refiner.refine(image.view(), {scene.found(-wider, wider)}, scene.camera, scene.pose()).front();
        expect_measured(refined, scene, 0.04);
        EXPECT_NEAR(refined.post.distance_m, straight, 0.012) << wider;  // a thirteenth of a pixel
    }
}

TEST(PostRefiner, UndoesTheLens) {
    DrawnPost scene;
    scene.camera.height = 240;
    scene.camera.cy = 119.5;
    scene.camera.distortion = {-0.2, 0.03, 0.001, -0.001, 0.0};
    scene.distance = 2.0;
    scene.bearing = 0.35;
    const RefinedPost refined = refine(scene, scene.found(1.0, 1.0));
    expect_measured(refined, scene, 0.008);
}

TEST(PostRefiner, APostThatFillsMostOfThePicture) {
    DrawnPost scene;
    scene.distance = 0.5;
    scene.camera = scaled_to(scene.camera, 320, 240);
    expect_measured(refine(scene, scene.found(6.0, -7.0)), scene, 0.001);
}

TEST(PostRefiner, ThePictureMayCutItsEnds) {
    DrawnPost scene = small_scene();
    scene.camera.height = 60;
    scene.camera.cy = 40.0;
    expect_measured(refine(scene, scene.found()), scene, 0.03);
}

TEST(PostRefiner, OneEdgeOutsideThePictureLeavesABearing) {
    DrawnPost scene = small_scene();
    scene.distance = 1.5;
    scene.bearing = 0.15;  // its left edge lies beyond the left border
    Post found = scene.found();
    found.left_top.x() = found.left_base.x() = 0.0;
    found.flags = post_flag::left_edge_missing | post_flag::cut_left | post_flag::no_distance;
    const RefinedPost refined = refine(scene, found);
    ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
    EXPECT_TRUE(refined.post.has(post_flag::left_edge_missing));
    EXPECT_TRUE(refined.post.has(post_flag::no_distance));
    EXPECT_FALSE(refined.left);
    ASSERT_TRUE(refined.right);
    const auto truth = silhouette(scene.cylinder(), scene.T_WC());
    EXPECT_LT((refined.right->plane - truth->right_plane).norm(), 2e-3);
    EXPECT_NEAR(refined.post.bearing_rad, 0.15, 3.0 * std::sqrt(refined.post.covariance(1, 1)));
}

TEST(PostRefiner, AnEdgeThatIsHiddenAllAlongLeavesABearing) {
    DrawnPost scene = small_scene();
    const double middle = 0.5 * (scene.found().left_top.x() + scene.found().right_top.x());
    scene.before = [middle](double x, double) {
        return x < middle - 2.0 ? std::optional<Levels>(Levels(30, 30, 34)) : std::nullopt;
    };
    const RefinedPost refined = refine(scene, scene.found());
    if (refined.post.has(post_flag::refined) && !refined.post.has(post_flag::no_distance))
        FAIL() << "an occluder's edge was taken for the post's: " << refined.post.distance_m;
}

TEST(PostRefiner, BackgroundOfItsColourOnOneSideGivesNoDistance) {
    DrawnPost scene = small_scene();
    scene.limb_darkening = 0.0;
    const double middle = 0.5 * (scene.found().left_top.x() + scene.found().right_top.x());
    const Levels yellow = scene.post;
    scene.behind = [middle, yellow](double x, double) { return x < middle ? yellow : grey; };
    const RefinedPost refined = refine(scene, scene.found());
    EXPECT_TRUE(!refined.post.has(post_flag::refined) || refined.post.has(post_flag::no_distance));
    if (refined.post.has(post_flag::refined)) {
        EXPECT_TRUE(refined.post.has(post_flag::left_edge_missing));
    }
}

TEST(PostRefiner, RowsWithoutContrastSayNothing) {
    DrawnPost scene = small_scene();
    const Levels yellow = scene.post;
    scene.behind = [yellow](double x, double y) { return x < 80.0 && y > 60.0 && y < 110.0 ? yellow : grey; };
    RefinementParameters parameters;
    parameters.most_rows = 250;  // none averaged: rows are those of the picture
    PostRefiner refiner(parameters, {});
    const YuyvImage image = scene.draw();
    const RefinedPost refined =
        refiner.refine(image.view(), {scene.found()}, scene.camera, scene.pose()).front();
    expect_measured(refined, scene, 0.015);
    EXPECT_LT(refined.left->rows, refined.right->rows - 30);
}

TEST(PostRefiner, AClippedChannelDoesNotMatter) {
    DrawnPost scene = small_scene();
    scene.post = {275, 224, 42};
    scene.behind = [](double, double) { return green; };
    expect_measured(refine(scene, scene.found()), scene, 0.05);  // clipping after the blur moves edges itself
}

TEST(PostRefiner, MeasuresWhitePosts) {
    DrawnPost scene = small_scene();
    scene.post = {225, 226, 222};
    scene.behind = [](double, double) { return green; };
    expect_measured(refine(scene, scene.found(0.6, -0.6)), scene, 0.03);
}

TEST(PostRefiner, DeclinesWhereThereIsNothingToSee) {
    DrawnPost scene = small_scene();
    scene.limb_darkening = 0.0;
    const Levels yellow = scene.post;
    scene.behind = [yellow](double, double) { return yellow; };
    const Post found = scene.found();
    const RefinedPost refined = refine(scene, found);
    EXPECT_FALSE(refined.post.has(post_flag::refined));
    EXPECT_FALSE(refined.reason.empty());
    EXPECT_EQ(refined.post.distance_m, found.distance_m);
    EXPECT_FALSE(refined.left || refined.right);
    EXPECT_TRUE(refined.cues.empty());
}

TEST(PostRefiner, AnOccluderOverFourTenthsTakesRowsAndNotTheFit) {
    for (const double inset : {-4.0, 1.5, 4.0}) {
        DrawnPost scene = small_scene();
        const Post exact = scene.found();
        const double edge = exact.left_top.x() + inset;
        const double from = exact.left_base.y() - 0.4 * (exact.left_base.y() - exact.left_top.y());
        scene.before = [edge, from](double x, double y) {
            return x < edge && y > from ? std::optional<Levels>(Levels(40, 40, 46)) : std::nullopt;
        };
        const RefinedPost refined = refine(scene, exact);
        expect_measured(refined, scene, 0.03);
        if (inset > 0.0) {
            EXPECT_LT(refined.left->rows, refined.right->rows - 25) << inset;
        }
    }
}

TEST(PostRefiner, StripesBehindThePostTakeRowsAndNotTheFit) {
    DrawnPost scene = small_scene();
    scene.distance = 4.0;
    scene.behind = [](double x, double y) {
        return std::fmod(x + 0.6 * y + 1000.0, 37.0) < 6.0 ? Levels(40, 60, 160) : grey;
    };
    expect_measured(refine(scene, scene.found()), scene, 0.05);
}

TEST(PostRefiner, GivesTheSameTwice) {
    const DrawnPost scene = small_scene();
    const YuyvImage image = scene.draw();
    PostRefiner refiner({}, {});
    const std::vector<Post> posts = {scene.found(), scene.found(1.0, 1.0)};
    const auto once = refiner.refine(image.view(), posts, scene.camera, scene.pose());
    const auto again = refiner.refine(image.view(), posts, scene.camera, scene.pose());
    PostRefiner fresh({}, {});
    const auto afresh = fresh.refine(image.view(), {posts[1]}, scene.camera, scene.pose());
    ASSERT_EQ(once.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(once[i].post.distance_m, again[i].post.distance_m);
        EXPECT_EQ(once[i].post.covariance, again[i].post.covariance);
    }
    EXPECT_EQ(once[1].post.distance_m, afresh[0].post.distance_m);
}

TEST(PostRefiner, WhatItMeasuredBeforeLeavesNoTrace) {
    PostRefiner used({}, {});
    for (const double blur : {0.6, 5.0, 0.9, 3.5}) {
        DrawnPost scene = small_scene();
        scene.blur = blur;
        scene.before = [](double, double y) -> std::optional<Levels> {
            if (std::fmod(y, 40.0) < 12.0) return Levels{30, 30, 200};
            return std::nullopt;
        };
        const YuyvImage image = scene.draw();
        for (const double moved : {-3.0, 0.0, 4.0}) {
            PostRefiner fresh({}, {});
            const std::vector<Post> posts = {scene.found(moved, -moved)};
            const RefinedPost expected =
                fresh.refine(image.view(), posts, scene.camera, scene.pose()).front();
            const RefinedPost refined = used.refine(image.view(), posts, scene.camera, scene.pose()).front();
            EXPECT_EQ(refined.reason, expected.reason);
            EXPECT_EQ(refined.quality, expected.quality);
            EXPECT_EQ(refined.post.distance_m, expected.post.distance_m);
            EXPECT_EQ(refined.post.covariance, expected.post.covariance);
        }
    }
}

TEST(PostRefiner, PixelsBeyondThePicturesBordersDoNotMatter) {
    const DrawnPost scene = small_scene();
    const YuyvImage drawn = scene.draw();
    const int width = 96;  // of a part of it, with the rest beyond its borders
    const int first = 2 * static_cast<int>(scene.found().left_top.x() / 2.0) - 40;
    const auto part_of = [&](const YuyvImage& image) {
        return YuyvView{image.data.data() + 2 * first, width, image.height, image.stride()};
    };
    YuyvImage other = drawn;
    for (int y = 0; y < other.height; ++y) {
        std::uint8_t* row = other.data.data() + static_cast<std::ptrdiff_t>(y) * other.stride();
        std::fill(row, row + 2 * first, std::uint8_t{250});
        std::fill(row + 2 * (first + width), row + other.stride(), std::uint8_t{3});
    }
    Intrinsics camera = scene.camera;
    camera.width = width;
    camera.cx -= first;
    for (int moved = -90; moved <= 90; moved += 3) {
        Post post = scene.found();
        for (auto* corner : {&post.left_top, &post.left_base, &post.right_top, &post.right_base})
            corner->x() += moved - first;
        PostRefiner one({}, {});
        PostRefiner two({}, {});
        const RefinedPost a = one.refine(part_of(drawn), {post}, camera, scene.pose()).front();
        const RefinedPost b = two.refine(part_of(other), {post}, camera, scene.pose()).front();
        EXPECT_EQ(a.reason, b.reason) << moved;
        EXPECT_EQ(a.quality, b.quality) << moved;
        EXPECT_EQ(a.post.distance_m, b.post.distance_m) << moved;
    }
}

TEST(PostRefiner, WhatAnEarlierMeasurementSaidOfItselfDoesNotCount) {
    DrawnPost scene = small_scene();
    Post post = scene.found();
    post.flags |= post_flag::refined;
    PostRefiner refiner({}, {});
    EXPECT_FALSE(refiner.refine({}, {post}, scene.camera, {}).front().post.has(post_flag::refined));
}

TEST(PostRefiner, DeclinesEmptyPicturesAndPostsThatAreNone) {
    PostRefiner refiner({}, {});
    const DrawnPost scene = small_scene();
    const YuyvImage image = scene.draw();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Post> posts(6);
    posts[1] = scene.found();
    posts[1].left_top.x() = nan;
    posts[2] = scene.found();
    posts[2].right_base.y() = std::numeric_limits<double>::infinity();
    posts[3] = scene.found(5000.0, 5000.0);
    posts[4] = scene.found(40.0, -40.0);  // left beyond right
    posts[5] = scene.found();
    posts[5].left_top.y() = posts[5].left_base.y();
    for (const RefinedPost& refined : refiner.refine(image.view(), posts, scene.camera, scene.pose())) {
        EXPECT_FALSE(refined.post.has(post_flag::refined));
        EXPECT_FALSE(refined.reason.empty());
    }
    for (const RefinedPost& refined : refiner.refine({}, {scene.found()}, scene.camera, {}))
        EXPECT_FALSE(refined.post.has(post_flag::refined));
    EXPECT_TRUE(refiner.refine(image.view(), {}, scene.camera, {}).empty());
}

TEST(PostRefiner, TakesOddAndTinyPictures) {
    PostRefiner refiner({}, {});
    for (const int width : {1, 2, 3, 7, 31, 161}) {
        for (const int height : {1, 2, 9, 33}) {
            const YuyvImage image(width, height);
            Intrinsics camera = from_horizontal_fov(width, height, 1.0);
            Post post;
            post.left_top = {0.2 * width, 0.0};
            post.left_base = {0.2 * width, height - 1.0};
            post.right_top = {0.8 * width, 0.0};
            post.right_base = {0.8 * width, height - 1.0};
            EXPECT_FALSE(
                refiner.refine(image.view(), {post}, camera, {}).front().post.has(post_flag::refined));
        }
    }
}

TEST(PostRefiner, WhatNoPictureTellsIsInTheCovariance) {
    const DrawnPost scene = small_scene();
    const YuyvImage image = scene.draw();
    RefinementParameters by_width;
    by_width.base_cue = by_width.height_cue = false;
    RefinementParameters unsure = by_width;
    unsure.focal_error = 0.01;
    unsure.diameter_error = 0.02;
    PostRefiner plain(by_width, {}), careful(unsure, {});
    const double sigma2 =
        plain.refine(image.view(), {scene.found()}, scene.camera, scene.pose()).front().post.covariance(0, 0);
    const Post post = careful.refine(image.view(), {scene.found()}, scene.camera, scene.pose()).front().post;
    const double more = post.distance_m * post.distance_m * (0.01 * 0.01 + 0.02 * 0.02);
    EXPECT_NEAR(post.covariance(0, 0), sigma2 + more, 1e-9);
}

/// Bias and honesty, over many pictures that differ in place, tilt and noise.
TEST(PostRefiner, ErrorsAreWhatTheCovarianceSays) {
    Random random(11);
    constexpr int pictures = 40;
    double sum = 0.0, standard = 0.0, squares = 0.0;
    PostRefiner refiner({}, {});
    for (int i = 0; i < pictures; ++i) {
        DrawnPost scene = small_scene();
        scene.distance = random.uniform(3.0, 5.0);
        scene.bearing = random.uniform(-0.03, 0.03);
        scene.roll = random.uniform(-0.1, 0.1);
        scene.seed = static_cast<std::uint64_t>(i) + 1;
        scene.behind = [](double, double y) { return y > 150.0 ? green : Levels(170, 172, 178); };
        const YuyvImage image = scene.draw();
        const RefinedPost refined =
            refiner
                .refine(image.view(), {scene.found(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0))},
                        scene.camera, scene.pose())
                .front();
        ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
        const double off = error(refined, scene) / std::sqrt(refined.post.covariance(0, 0));
        sum += off;
        standard += std::abs(off) < 1.0 ? 1.0 : 0.0;
        squares += off * off;
    }
    EXPECT_LT(std::abs(sum / pictures), 0.5);  // three sigmas of the mean
    EXPECT_GT(squares / pictures, 0.5);
    EXPECT_LT(squares / pictures, 1.8);
    EXPECT_GT(standard / pictures, 0.45);
}

}  // namespace
}  // namespace goalmouth::test
