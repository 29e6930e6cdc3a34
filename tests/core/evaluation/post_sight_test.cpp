#include "core/evaluation/post_sight.h"

#include "core/evaluation/cell_renderer.h"
#include "core/evaluation/edge_path.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

EvaluationScene lit_scene() {
    EvaluationScene scene;
    scene.name = "lit";
    scene.formation.hall.own_goal = false;
    scene.formation.hall.posters = 0;
    scene.formation.hall.spectators = 0;
    scene.formation.sensor.read_noise = 2.0;
    scene.formation.sensor.photon_noise = 0.1;
    return scene;
}

PostSight sight_in(const EvaluationScene& scene, int cell, int index = 0, const Intrinsics& camera = {}) {
    return CellRenderer(scene, {}, camera, 5).render(cell, index).sight.value();
}

double length(const std::vector<EdgePiece>& pieces) {
    double sum = 0.0;
    for (const EdgePiece& piece : pieces) sum += piece.length;
    return sum;
}

TEST(PostSight, FollowsTheTrueEdgesThroughLensAndShutter) {
    EvaluationScene scene = lit_scene();
    scene.parameters.lens = {.k1 = -0.1};
    scene.parameters.motion = {.speed = 0.1, .roll_rate = 0.5, .pitch_rate = 0.3, .yaw_rate = 1.0};
    scene.formation.shutter = {.exposure = 0.01, .readout = 0.03};
    CellRenderer renderer(scene, {}, {}, 5);
    for (const int cell : {2, 10, 17}) {
        const CellFrame frame = renderer.render(cell, 1);
        ASSERT_TRUE(frame.sight);
        const Cylinder post = goalposts(Field{})[post_in_line];
        const auto paths =
            edges_in_picture(renderer.camera(), frame.view.camera, scene.formation.shutter, post);
        for (std::size_t side = 0; side < 2; ++side) {
            ASSERT_GT(frame.sight->edges[side].size(), 30U);
            for (const EdgePiece& piece : frame.sight->edges[side])
                EXPECT_NEAR(piece.pixel.x(), paths[side].x_at(piece.pixel.y()), 0.1) << "cell " << cell;
        }
    }
}

TEST(PostSight, IsAsLongAsThePostInThePicture) {
    for (const int cell : {3, 5, 17}) {
        const EvaluationScene scene = lit_scene();
        CellRenderer renderer(scene, {}, {}, 5);
        const CellFrame frame = renderer.render(cell, 0);
        for (const KnownPost& post : frame.posts) {
            if (post.truth.id != post_in_line) continue;
            const double rows = (post.outline.left_base - post.outline.left_top).norm();
            EXPECT_NEAR(length(frame.sight->edges[0]), rows, 2.0);
            EXPECT_GT(frame.sight->seen[0], 0.85);
            EXPECT_LE(frame.sight->seen[0], 1.0);
            EXPECT_GT(frame.sight->seen[1], 0.85);
            EXPECT_TRUE(frame.sight->both_edges());
        }
    }
}

// σ_D = D²/(w γ) (σ_n/A) √(4√π σ_b/L) at 6 m: 36/55 m, 90 rows, σ_b 1.03 px, and a pair's contrast of about
// 40 times its noise, half a pair for each pixel: 6.5 mm.
TEST(PostSight, BoundsTheDistanceByAsMuchAsIsKnown) {
    const EvaluationScene scene = lit_scene();
    const double far = sight_in(scene, 5).bound.value().distance_sigma();
    EXPECT_NEAR(far, 0.0065, 0.0015);
    const double middle = sight_in(scene, 2).bound.value().distance_sigma();
    EXPECT_NEAR(far / middle, std::pow(2.0, 2.5), 1.5) << "D² for the angle, √D for the length of the edges";
    const double fine =
        sight_in(scene, 5, 0, scaled_to(Intrinsics{}, 1600, 1200)).bound.value().distance_sigma();
    EXPECT_NEAR(far / fine, std::pow(2.5, 1.5), 0.6) << "at 2.5 times the size";
}

TEST(PostSight, KnowsNoiseAndBlur) {
    EvaluationScene scene = lit_scene();
    scene.formation.sensor.photon_noise = 0.0;
    scene.formation.sensor.read_noise = 4.0;
    const PostSight plain = sight_in(scene, 3);
    scene.formation.sensor.read_noise = 8.0;
    EXPECT_NEAR(sight_in(scene, 3).bound->distance_sigma() / plain.bound->distance_sigma(), 2.0, 0.04)
        << "but for rounding";
    scene.formation.sensor.read_noise = 4.0;
    scene.formation.sensor.blur = 2.0;
    const double blurred = sight_in(scene, 3).bound->distance_sigma() / plain.bound->distance_sigma();
    EXPECT_NEAR(blurred, std::sqrt(std::sqrt((4.0 + 1.0 / 3.0) / (0.7225 + 1.0 / 3.0))), 0.03);
    scene.formation.sensor.blur = 0.85;
    scene.parameters.motion.yaw_rate = 2.0;
    scene.formation.shutter.exposure = 0.01;
    EXPECT_GT(sight_in(scene, 3, 3).bound->distance_sigma(),
              1.1 * CellRenderer(lit_scene(), {}, {}, 5).render(3, 3).sight->bound->distance_sigma())
        << "smeared by the turn";
}

TEST(PostSight, ReadsTheColoursBesideTheEdges) {
    EvaluationScene scene = lit_scene();
    const PostSight yellow = sight_in(scene, 3);
    EXPECT_TRUE(yellow.both_edges());
    // Beside the left edge stands the crossbar, for as many rows as it is thick.
    int crossbar = 0;
    for (const EdgePiece& piece : yellow.edges[0]) {
        EXPECT_LT(piece.look.post.y(), -30.0) << "yellow has little blue";
        if (piece.look.background.y() < -30.0) ++crossbar;
    }
    EXPECT_GT(crossbar, 0);
    EXPECT_LT(crossbar, static_cast<int>(yellow.edges[0].size()) / 4);
    scene.formation.hall.wall = scene.formation.hall.carpet = scene.formation.hall.line =
        scene.formation.hall.floor = scene.formation.hall.yellow_goal;
    scene.formation.hall.goal_frame = false;
    const PostSight camouflaged = sight_in(scene, 3);
    EXPECT_FALSE(camouflaged.both_edges()) << "but for the walls' skirting";
    EXPECT_LT(camouflaged.seen[0], 0.2);
    EXPECT_GT(camouflaged.bound->distance_sigma(), 2.0 * yellow.bound->distance_sigma());
}

TEST(PostSight, SeesNoEdgeBehindARobot) {
    EvaluationScene scene = lit_scene();
    CellRenderer clear(scene, {}, {}, 5);
    scene.parameters.occluders.share = 1.0;
    CellRenderer occluded(scene, {}, {}, 5);
    int shorter = 0;
    for (int index = 0; index < 40; ++index) {
        const CellFrame behind = occluded.render(2, index);
        if (!behind.sight) continue;  // too much is hidden
        const CellFrame open = clear.render(2, index);
        const double all = length(open.sight->edges[0]) + length(open.sight->edges[1]);
        const double left = length(behind.sight->edges[0]) + length(behind.sight->edges[1]);
        double visible = 1.0;
        for (const KnownPost& post : behind.posts)
            if (post.truth.id == post_in_line) visible = post.truth.visible / post.truth.inside;
        EXPECT_NEAR(left / all, visible, 0.3)
            << "a robot's limb hides area and no edge, or the other way round";
        if (left < 0.95 * all) {
            ++shorter;
            EXPECT_GT(behind.sight->bound->distance_sigma(), open.sight->bound->distance_sigma());
        }
    }
    EXPECT_GT(shorter, 3);
}

}  // namespace
}  // namespace goalmouth
