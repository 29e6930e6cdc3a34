#include "core/refinement/coarse_edges.h"

#include "core/refinement/pixel_rays.h"
#include "tests/core/refinement/drawn_post.h"

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

TEST(CoarseEdges, AreSeenBesideBlack) {
    DrawnPost scene = small_scene();
    scene.behind = [&](double x, double) {
        return x > 0.5 * scene.camera.width ? Levels(8, 8, 10) : Levels(150, 150, 155);
    };
    const YuyvImage image = scene.draw();
    const RoughOutline outline = rough_outline_of(scene);
    const PostColour colour = colour_of(scene, image.view());
    const auto edges = CoarseEdgeFinder().find(image.view(), outline, colour, scene.camera, {});
    PixelRays rays(scene.camera);
    const double y = 0.5 * (outline.first_row + outline.last_row);
    ASSERT_TRUE(edges[0] && edges[1]);
    EXPECT_NEAR(rays.crossing(edges[0]->plane, outline.left(y), y).x, outline.left(y), 0.5);
    EXPECT_NEAR(rays.crossing(edges[1]->plane, outline.right(y), y).x, outline.right(y), 1.0);
}

}  // namespace
}  // namespace goalmouth::test
