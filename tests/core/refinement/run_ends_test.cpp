#include "core/refinement/run_ends.h"

#include "core/geometry/cylinder.h"
#include "tests/core/refinement/drawn_post.h"

#include <array>
#include <optional>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

constexpr double blur = 0.85;

/// The silhouette of the scene's post with its edges turned outwards [px].
PostSilhouette silhouette_of(const DrawnPost& scene, double left_out, double right_out) {
    const auto truth = silhouette(scene.cylinder(), scene.T_WC());
    const Eigen::Vector3d up = scene.T_WC().linear().transpose() * Eigen::Vector3d::UnitZ();
    const auto turned = [&](const Eigen::Vector3d& plane, double px) {
        return Eigen::AngleAxisd(px / scene.camera.fx, -up) * plane;
    };
    return silhouette_between(turned(truth->left_plane, -left_out), turned(truth->right_plane, right_out),
                              up);
}

std::array<RunEnds, 2> look(const DrawnPost& scene, const PostSilhouette& post) {
    const YuyvImage image = scene.draw();
    const RoughOutline outline = rough_outline_of(scene);
    PostExtent extent;
    extent.first_edge_row = outline.first_row;
    extent.last_edge_row = outline.last_row;
    return run_ends(image.view(), post, colour_of(scene, image.view()), scene.camera, extent, blur);
}

TEST(RunEnds, AreAtTheEdgesOfThePost) {
    const DrawnPost scene = small_scene();
    for (const RunEnds& ends : look(scene, silhouette_of(scene, 0.0, 0.0))) {
        EXPECT_GT(ends.here(), 60);
        EXPECT_LT(ends.inside().rows, 6);
        EXPECT_LT(ends.outside().rows, 6);
    }
}

TEST(RunEnds, LieWithinWhatIsTooWide) {
    const DrawnPost scene = small_scene();
    const auto ends = look(scene, silhouette_of(scene, 0.0, 8.0));
    EXPECT_GT(ends[0].here(), 60);
    EXPECT_LT(ends[1].here(), 6);
    EXPECT_GT(ends[1].inside().rows, 40);
    EXPECT_NEAR(ends[1].inside().beyond, -8.0, 1.0);
}

TEST(RunEnds, LieBeyondWhatIsTooNarrow) {
    const DrawnPost scene = small_scene();
    const auto ends = look(scene, silhouette_of(scene, 0.0, -6.0));
    EXPECT_GT(ends[0].here(), 60);
    EXPECT_LT(ends[1].here(), 6);
    EXPECT_GT(ends[1].outside().rows, 40);
    EXPECT_NEAR(ends[1].outside().beyond, 6.0, 1.0);
}

TEST(RunEnds, LieFarBeyondWhatIsHardlyAQuarterOfIt) {
    const DrawnPost scene = small_scene();
    const auto ends = look(scene, silhouette_of(scene, 0.0, -14.0));
    EXPECT_LT(ends[1].outside().rows, 6);
    EXPECT_GT(ends[1].far_outside().rows, 40);
    EXPECT_NEAR(ends[1].far_outside().beyond, 14.0, 1.0);
    EXPECT_LT(ends[0].far_outside().rows, 6);
}

TEST(RunEnds, OfAWidePostAreToldFromAPolesThatSticksOutByFivePixels) {
    DrawnPost scene = small_scene();
    scene.distance = 0.55;
    scene.bearing = 0.06;  // its right edge is in the picture
    const Post corners = scene.found();
    scene.behind = [&](double x, double y) {
        return y < 150.0 && x > 40.0 && x < corners.right_top.x() + 5.0 ? scene.post : Levels(150, 150, 155);
    };
    const auto ends = look(scene, silhouette_of(scene, 0.0, 0.0));
    EXPECT_GT(ends[1].outside().rows, 20);
    EXPECT_GT(ends[1].here(), 20);
}

TEST(RunEnds, AreWhereBlackBegins) {
    DrawnPost scene = small_scene();
    scene.behind = [](double, double) { return Levels(6, 6, 8); };
    for (const RunEnds& ends : look(scene, silhouette_of(scene, 4.0, 4.0))) {
        EXPECT_LT(ends.here(), 6);
        EXPECT_GT(ends.inside().rows, 40);
        EXPECT_NEAR(ends.inside().beyond, -3.0, 1.5);  // the edge's blur is the post's until it is dark
    }
}

TEST(RunEnds, OfAThingOfThePostsColourBehindSomeRowsAreFewer) {
    DrawnPost scene = small_scene();
    const Post corners = scene.found();
    const double end = corners.right_top.y() + 0.3 * (corners.right_base.y() - corners.right_top.y());
    scene.behind = [&](double x, double y) {
        return y < end && x > 0.5 * scene.camera.width && x < corners.right_top.x() + 9.0
                   ? scene.post
                   : Levels(150, 150, 155);
    };
    const auto ends = look(scene, silhouette_of(scene, 0.0, 0.0));
    EXPECT_GT(ends[1].outside().rows, 15);
    EXPECT_NEAR(ends[1].outside().beyond, 9.0, 2.0);
    EXPECT_GT(ends[1].here(), ends[1].outside().rows);
    for (const RunEnd& row : ends[1].rows) EXPECT_TRUE(row.y < end + 3.0 || ends[1].ends_here(row)) << row.y;
}

TEST(RunEnds, AreNoneWhereTheColourGoesOnToThePicturesSide) {
    DrawnPost scene = small_scene();
    scene.behind = [&](double x, double) {
        return x > 0.5 * scene.camera.width ? scene.post : Levels(150, 150, 155);
    };
    const auto ends = look(scene, silhouette_of(scene, 0.0, 0.0));
    EXPECT_GT(ends[0].here(), 60);
    EXPECT_LT(ends[1].outside().rows, 5);
    EXPECT_LT(ends[1].here(), 5);
}

TEST(RunEnds, AreFoundInWhicheverPartOfARowShowsThePost) {
    // Before the right half of the lower rows there is something; the left edge is free.
    DrawnPost scene = small_scene();
    const Post corners = scene.found();
    const double middle = 0.5 * (corners.left_top.x() + corners.right_top.x());
    scene.before = [&](double x, double y) {
        return y > 0.5 * scene.camera.height && x > middle && x < middle + 30.0
                   ? std::optional<Levels>(Levels(40, 40, 40))
                   : std::nullopt;
    };
    const auto ends = look(scene, silhouette_of(scene, 0.0, 0.0));
    EXPECT_GT(ends[0].here(), 60);
    EXPECT_LT(ends[1].here(), ends[0].here());
    EXPECT_GT(ends[1].inside().rows, 15);
}

}  // namespace
}  // namespace goalmouth::test
