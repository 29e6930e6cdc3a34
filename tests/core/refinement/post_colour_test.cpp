#include "core/refinement/post_colour.h"

#include "tests/core/refinement/drawn_post.h"

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

PostColour colour_of(const DrawnPost& scene) {
    return test::colour_of(scene, scene.draw().view());
}

bool is_like(const PostColour& post, const PairColour& colour) {
    return post.difference(colour) < 20.0F * post.spread;
}

TEST(PostColour, IsThePostsInShadowToo) {
    const PostColour post = colour_of(small_scene());
    for (const float light : {1.1F, 0.8F, 0.5F}) EXPECT_TRUE(is_like(post, light * post.mean)) << light;
}

TEST(PostColour, IsNotBlack) {
    for (const double noise : {1.0, 3.0, 8.0}) {
        DrawnPost scene = small_scene();
        scene.noise = noise;
        const PostColour post = colour_of(scene);
        for (const float luma : {0.0F, 12.0F, 40.0F})
            EXPECT_FALSE(is_like(post, {luma, 0.0F, 0.0F})) << luma << " noise " << noise;
    }
}

TEST(PostColour, OfAWhitePostIsGreyButNotBlack) {
    DrawnPost scene = small_scene();
    scene.post = {210, 210, 210};
    scene.behind = [](double, double) { return Levels(60, 110, 60); };
    const PostColour post = colour_of(scene);
    for (const float light : {1.1F, 0.8F, 0.5F}) EXPECT_TRUE(is_like(post, light * post.mean)) << light;
    EXPECT_FALSE(is_like(post, {12.0F, 0.0F, 0.0F}));
}

}  // namespace
}  // namespace goalmouth::test
