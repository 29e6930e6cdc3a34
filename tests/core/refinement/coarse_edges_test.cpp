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
    const Post corners = scene.found();
    RoughOutline outline{corners.left_top, corners.left_base, corners.right_top, corners.right_base};
    outline.first_row = static_cast<int>(corners.left_top.y()) + 2;
    outline.last_row = static_cast<int>(corners.left_base.y()) - 2;
    PostColour colour;
    ASSERT_TRUE(PostColourEstimator().estimate(image.view(), outline, {}, CameraResponse::linear, colour));
    const auto edges = CoarseEdgeFinder().find(image.view(), outline, colour, scene.camera, {});
    PixelRays rays(scene.camera);
    const double y = 0.5 * (outline.first_row + outline.last_row);
    ASSERT_TRUE(edges[0] && edges[1]);
    EXPECT_NEAR(rays.crossing(edges[0]->plane, outline.left(y), y).x, outline.left(y), 0.5);
    EXPECT_NEAR(rays.crossing(edges[1]->plane, outline.right(y), y).x, outline.right(y), 1.0);
}

}  // namespace
}  // namespace goalmouth::test
