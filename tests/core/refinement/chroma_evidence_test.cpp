#include "core/refinement/chroma_evidence.h"

#include "core/refinement/post_refiner.h"
#include "tests/core/refinement/drawn_post.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::DrawnPost;
using test::Levels;

/// A camera's picture of which the chroma lies so far right of the luma [px].
YuyvImage drawn(const DrawnPost& scene, double shift) {
    YuyvImage image = scene.draw();
    DrawnPost beside = scene;
    beside.camera.cx += shift;
    const YuyvImage chroma = beside.draw();
    for (std::size_t i = 1; i < image.data.size(); i += 2) image.data[i] = chroma.data[i];
    return image;
}

RefinedPost refined(const DrawnPost& scene, double shift, const std::string& chroma_shift) {
    RefinementParameters parameters;
    parameters.chroma_shift = chroma_shift;
    PostRefiner refiner(parameters, {});
    const YuyvImage image = drawn(scene, shift);
    return refiner.refine(image.view(), {scene.found()}, scene.camera, scene.pose())[0];
}

ChromaEvidence evidence_of(const YuyvImage& image, const DrawnPost& scene) {
    const Post post = scene.found();
    RoughOutline outline{post.left_top, post.left_base, post.right_top, post.right_base};
    outline.first_row = std::max(0, static_cast<int>(std::ceil(post.left_top.y())));
    outline.last_row = std::min(image.height - 1, static_cast<int>(std::floor(post.left_base.y())));
    PostColourEstimator colours;
    PostColour colour;
    EXPECT_TRUE(colours.estimate(image.view(), outline, {}, CameraResponse::linear, colour));
    CoarseEdgeFinder finder;
    const auto edges = finder.find(image.view(), outline, colour, scene.camera, {});
    return chroma_evidence(image.view(), outline, colour, scene.camera, edges);
}

/// A post before a wall as dark as the posts of photographs have behind them.
DrawnPost before_the_dark() {
    DrawnPost scene;
    scene.distance = 2.0;
    scene.bearing = 0.1;
    scene.behind = [](double, double) { return Levels(60, 64, 60); };
    return scene;
}

TEST(ChromaEvidence, TellsByHowMuchChromaLiesBesideTheLuma) {
    DrawnPost scene = before_the_dark();
    for (const double shift : {-2.0, -0.5, 0.5, 1.4, 2.0})
        EXPECT_NEAR(evidence_of(drawn(scene, shift), scene).shift(), shift, 0.15);
    EXPECT_EQ(evidence_of(drawn(scene, 0.0), scene).shift(), 0.0);

    scene.behind = [](double, double y) { return y < 200.0 ? Levels(250, 250, 250) : Levels(20, 90, 25); };
    EXPECT_NEAR(evidence_of(drawn(scene, 1.4), scene).shift(), 1.4, 0.3)
        << "before something brighter above and before the field below";
}

TEST(ChromaEvidence, NeedsBothSides) {
    const DrawnPost scene = before_the_dark();
    const ChromaEvidence there = evidence_of(drawn(scene, 2.0), scene);
    ChromaEvidence one = there, opposite = there;
    one.side(1) = ChromaLag();
    EXPECT_EQ(one.shift(), 0.0) << "no right edge";
    opposite.side(1) = evidence_of(drawn(scene, -0.5), scene).side(1);
    EXPECT_EQ(opposite.shift(), 0.0) << "a shadow on one side, a lamp on the other";
    EXPECT_EQ(ChromaEvidence().shift(), 0.0);
}

TEST(ChromaEvidence, WhereLumaShowsAPostsShadingThereIsNone) {
    DrawnPost scene = before_the_dark();
    scene.behind = [](double, double) { return Levels(140, 140, 140); };  // as bright as the post's sides
    ChromaEvidence evidence = evidence_of(scene.draw(), scene);
    for (std::size_t side = 0; side < 2; ++side) EXPECT_FALSE(evidence.side(side).told()) << side;
}

TEST(ChromaEvidence, OfAGreyPostThereIsNone) {
    DrawnPost scene = before_the_dark();
    scene.post = {220, 215, 204};  // nearly
    scene.noise = 0.5;
    EXPECT_EQ(evidence_of(drawn(scene, 2.0), scene).shift(), 0.0);
}

TEST(ChromaEvidence, PostsAreMeasuredWhereTheirLumaIs) {
    const DrawnPost scene = before_the_dark();
    const auto pixels_off = [&](const Post& post) {
        return std::abs(post.bearing_rad - scene.bearing) * scene.camera.fx;
    };
    const auto metres_off = [&](const Post& post) { return std::abs(post.distance_m - scene.distance); };
    const RefinedPost left_there = refined(scene, 1.5, "none");
    EXPECT_TRUE(!left_there.post.has(post_flag::refined) || pixels_off(left_there.post) > 1.5)
        << "the scene shows what there is to undo";
    const RefinedPost found = refined(scene, 1.5, "auto");
    ASSERT_TRUE(found.post.has(post_flag::refined)) << found.reason;
    const Post& undone = found.post;
    EXPECT_LT(pixels_off(undone), 0.5);
    EXPECT_LT(metres_off(undone), 0.005);
    EXPECT_EQ(refined(scene, 0.0, "auto").post.distance_m, refined(scene, 0.0, "none").post.distance_m);
}

}  // namespace
}  // namespace goalmouth
