#include "core/evaluation/cell_renderer.h"
#include "core/simulation/robot.h"
#include "tests/support/edge_at.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::x_at;

constexpr std::uint64_t seed = 5;

EvaluationScene plain_scene() {
    EvaluationScene scene;
    scene.name = "plain";
    scene.formation.hall.own_goal = false;
    scene.formation.hall.posters = 2;
    scene.formation.hall.spectators = 0;
    return scene;
}

Intrinsics small_camera() {
    return scaled_to(Intrinsics{}, 160, 120);
}

const KnownPost* in_line(const CellFrame& frame) {
    for (const KnownPost& post : frame.posts)
        if (post.truth.id == post_in_line) return &post;
    return nullptr;
}

TEST(Cell, CoversThePapersDistancesAndTilts) {
    std::set<std::pair<int, int>> cells;
    for (int i = 0; i < cell_count; ++i)
        cells.insert({evaluation_cell(i).distance_cm, evaluation_cell(i).tilt_deg});
    EXPECT_EQ(cells.size(), 18U);
    EXPECT_EQ(evaluation_cell(0), (EvaluationCell{60, 0}));
    EXPECT_EQ(evaluation_cell(17), (EvaluationCell{600, 20}));
    EXPECT_NE(frame_number(0, most_frames_per_cell - 1), frame_number(1, 0));
}

TEST(CellView, StandsInLineWithTheRightPostAtTheCellsDistance) {
    const Field field;
    EvaluationSceneParameters parameters;
    for (int cell = 0; cell < cell_count; ++cell) {
        const EvaluationCell wanted = evaluation_cell(cell);
        for (std::uint64_t i = 0; i < 20; ++i) {
            const CellView view = draw_view(Random(i), parameters, field, wanted, Intrinsics{});
            const Eigen::Isometry3d& T = view.camera.T_WC;
            EXPECT_DOUBLE_EQ(T.translation().x(), 0.5 * field.length - wanted.distance());
            EXPECT_DOUBLE_EQ(T.translation().y(), -0.5 * field.goal_width);
            EXPECT_DOUBLE_EQ(T.translation().z(), parameters.view.camera_height);
            const Eigen::Vector3d ahead = T.linear().col(2);
            EXPECT_LE(std::abs(std::atan2(ahead.y(), ahead.x())), parameters.view.yaw);
            const double down = -std::asin(ahead.z());
            EXPECT_GE(down, parameters.view.pitch_lowest - 1e-12);
            EXPECT_LE(down, parameters.view.pitch_highest);
            // The image's x axis leans against the horizon by the tilt.
            EXPECT_NEAR(std::abs(std::asin(T.linear().col(0).z() / std::cos(down))), wanted.tilt(), 1e-9);
            EXPECT_EQ(view.told, Intrinsics{});
            EXPECT_TRUE(view.camera.still());
            EXPECT_FALSE(view.occluder);
        }
    }
}

TEST(CellView, LeansToEitherSideAndLooksToEither) {
    int to_right = 0;
    int left = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const CellView view = draw_view(Random(i), {}, {}, {300, 20}, Intrinsics{});
        if (view.camera.T_WC.linear().col(0).z() > 0.0) ++to_right;
        if (view.camera.T_WC.linear().col(2).y() > 0.0) ++left;
    }
    EXPECT_NEAR(to_right, 100, 40);
    EXPECT_NEAR(left, 100, 40);
}

TEST(CellView, DrawsTheSameWhateverIsUsed) {
    EvaluationSceneParameters moving;
    moving.motion = {.speed = 0.15, .roll_rate = 0.4, .pitch_rate = 0.3, .yaw_rate = 0.5};
    moving.lens = {.k1 = -0.1, .distortion_known = false, .focal_error = 0.01, .centre_error = 2.0};
    moving.occluders.share = 1.0;
    const Intrinsics camera = true_camera(Intrinsics{}, moving.lens);
    EXPECT_EQ(camera.distortion[0], -0.1);
    const EvaluationCell cell{350, 10};
    const CellView plain = draw_view(Random(9), {}, {}, cell, Intrinsics{});
    const CellView moved = draw_view(Random(9), moving, {}, cell, camera);
    EXPECT_TRUE(plain.camera.T_WC.isApprox(moved.camera.T_WC, 0.0));
    EXPECT_EQ(plain.time, moved.time);
    EXPECT_FALSE(moved.camera.still());
    EXPECT_EQ(moved.camera.velocity.z(), 0.0);
    ASSERT_TRUE(moved.occluder);
    EXPECT_FALSE(moved.told.has_distortion());
    EXPECT_NE(moved.told.fx, camera.fx);
    EXPECT_DOUBLE_EQ(moved.told.fx / camera.fx, moved.told.fy / camera.fy);
}

TEST(CellView, ErrsAsMuchAsTheLensSays) {
    EvaluationSceneParameters parameters;
    parameters.lens = {.focal_error = 0.01, .centre_error = 2.0};
    const Intrinsics camera = scaled_to(Intrinsics{}, 1280, 960);
    double focal = 0.0;
    double centre = 0.0;
    constexpr int draws = 2000;
    for (std::uint64_t i = 0; i < draws; ++i) {
        const CellView view = draw_view(Random(i), parameters, {}, {300, 0}, camera);
        focal += std::pow(view.told.fx / camera.fx - 1.0, 2);
        centre += std::pow(view.told.cx - camera.cx, 2);
    }
    EXPECT_NEAR(std::sqrt(focal / draws), 0.01, 0.0006);
    EXPECT_NEAR(std::sqrt(centre / draws), 4.0, 0.25) << "2 px at 640 px of width";
}

TEST(CellView, KeepsOccludersBetweenCameraAndPost) {
    EvaluationSceneParameters parameters;
    parameters.occluders.share = 0.5;
    int occluded = 0;
    int fallen = 0;
    for (const int distance : {60, 300}) {
        for (std::uint64_t i = 0; i < 200; ++i) {
            const auto view = draw_view(Random(i), parameters, {}, {distance, 0}, Intrinsics{});
            if (!view.occluder) continue;
            ++occluded;
            fallen += view.occluder->fallen ? 1 : 0;
            const double away = view.occluder->way * distance;  // cm
            EXPECT_GE(away, 25.0);
            EXPECT_GE(distance - away, 25.0);
            EXPECT_GE(view.occluder->way, 0.25);
            EXPECT_LE(view.occluder->way, 0.75);
            EXPECT_LE(std::abs(view.occluder->sideways), 1.0);
        }
    }
    EXPECT_NEAR(occluded, 200, 60);
    EXPECT_NEAR(fallen, occluded / 2, 50);
}

TEST(CellRenderer, IsAFunctionOfSceneSeedCellAndIndex) {
    CellRenderer first(plain_scene(), {}, small_camera(), seed);
    CellRenderer second(plain_scene(), {}, small_camera(), seed);
    const CellFrame a = first.render(7, 3);
    second.render(0, 0);
    second.render(17, 1);
    const CellFrame b = second.render(7, 3);
    EXPECT_EQ(a.image.data, b.image.data);
    EXPECT_TRUE(a.view.camera.T_WC.isApprox(b.view.camera.T_WC, 0.0));
    ASSERT_EQ(a.posts.size(), b.posts.size());
    EXPECT_EQ(a.posts[0].outline.left_top, b.posts[0].outline.left_top);

    EXPECT_NE(second.render(7, 4).image.data, a.image.data);
    EXPECT_NE(second.render(8, 3).image.data, a.image.data);
    CellRenderer other_seed(plain_scene(), {}, small_camera(), seed + 1);
    EXPECT_NE(other_seed.render(7, 3).image.data, a.image.data);
    EvaluationScene renamed = plain_scene();
    renamed.name = "other";
    CellRenderer other_scene(renamed, {}, small_camera(), seed);
    EXPECT_NE(other_scene.render(7, 3).image.data, a.image.data);
}

TEST(CellRenderer, SeesTheSamePlacesAtAnySize) {
    CellRenderer small(plain_scene(), {}, small_camera(), seed);
    CellRenderer large(plain_scene(), {}, scaled_to(Intrinsics{}, 320, 240), seed);
    EXPECT_TRUE(small.render(2, 1).view.camera.T_WC.isApprox(large.render(2, 1).view.camera.T_WC, 0.0));
}

TEST(CellRenderer, KnowsThePostInLine) {
    CellRenderer renderer(plain_scene(), {}, small_camera(), seed);
    for (const int cell : {0, 5, 8, 17}) {
        const CellFrame frame = renderer.render(cell, 0);
        const KnownPost* post = in_line(frame);
        ASSERT_NE(post, nullptr);
        const EvaluationCell wanted = evaluation_cell(cell);
        EXPECT_NEAR(post->truth.distance_m, wanted.distance(), 1e-12);
        EXPECT_TRUE(post->outline.counts);
        // Its width along the row is that of a cylinder at that distance, seen askew.
        const ReferencePost& o = post->outline;
        const double row = 0.5 * (o.left_top.y() + o.right_base.y());
        const double width = x_at(o.right_top, o.right_base, row) - x_at(o.left_top, o.left_base, row);
        const double straight = 2.0 * renderer.camera().fx * std::tan(std::asin(0.05 / wanted.distance()));
        EXPECT_NEAR(width, straight / std::cos(wanted.tilt()), 0.06 * width);
        const double lean = std::atan2(o.left_base.x() - o.left_top.x(), o.left_base.y() - o.left_top.y());
        EXPECT_NEAR(std::abs(lean), wanted.tilt(), 0.06);
    }
}

TEST(CellRenderer, ShowsThePostWhereItsOutlineIs) {
    EvaluationScene scene = plain_scene();
    scene.formation.sensor.read_noise = 0.0;
    scene.formation.sensor.blur = 0.0;
    scene.parameters.lens = {.k1 = -0.2};
    scene.parameters.motion = {.yaw_rate = 1.0};
    scene.formation.shutter.readout = 0.03;
    CellRenderer renderer(scene, {}, Intrinsics{}, seed);
    for (const int cell : {1, 10, 15}) {
        const CellFrame frame = renderer.render(cell, 0);
        const KnownPost* post = in_line(frame);
        ASSERT_NE(post, nullptr);
        const ReferencePost& o = post->outline;
        int right = 0;
        int rows = 0;
        for (int row = static_cast<int>(o.left_top.y()) + 20; row < static_cast<int>(o.left_base.y()) - 20;
             row += 3) {
            const double l = x_at(o.left_top, o.left_base, row);
            const double r = x_at(o.right_top, o.right_base, row);
            if (l < 4.0 || r > renderer.camera().width - 5.0) continue;
            const auto yellow = [&](double x) {
                return frame.image.view().at(static_cast<int>(std::lround(x)), row).cb < 90;
            };
            ++rows;  // the straight line is within 3 px of the bent edge
            if (yellow(l + 4.0) && yellow(r - 4.0) && !yellow(l - 4.0) && !yellow(r + 4.0)) ++right;
        }
        EXPECT_GT(rows, 10);
        EXPECT_GE(right, rows * 9 / 10) << "cell " << cell;
    }
}

TEST(CellRenderer, HidesThePostBehindARobot) {
    EvaluationScene scene = plain_scene();
    scene.parameters.occluders.share = 1.0;
    CellRenderer occluded(scene, {}, small_camera(), seed);
    CellRenderer clear(plain_scene(), {}, small_camera(), seed);
    int hidden = 0;
    int uncounted = 0;
    for (int index = 0; index < 30; ++index) {
        const CellFrame frame = occluded.render(2, index);
        EXPECT_TRUE(frame.view.occluder);
        const KnownPost* post = in_line(frame);
        const CellFrame without = clear.render(2, index);
        EXPECT_NE(frame.image.data, without.image.data) << "there is a robot in the picture";
        ASSERT_NE(post, nullptr);
        if (post->truth.visible < 0.95 * post->truth.inside) ++hidden;
        if (!post->outline.counts) ++uncounted;
        EXPECT_TRUE(in_line(without)->outline.counts);
        EXPECT_EQ(post->outline.counts, 1.0 - post->truth.visible / post->truth.inside <= 0.4);
    }
    EXPECT_GT(hidden, 5);
    EXPECT_LT(hidden, 30) << "off to the side it hides nothing";
    EXPECT_GT(uncounted, 0);
}

TEST(CellRenderer, StandsNoHallsRobotWhereTheCameraIs) {
    EvaluationScene scene = plain_scene();
    scene.formation.hall.robots = 12;
    CellRenderer renderer(scene, {}, small_camera(), seed);
    for (int index = 0; index < 10; ++index) {
        const CellFrame frame = renderer.render(4, index);
        ASSERT_NE(in_line(frame), nullptr);
        EXPECT_GT(in_line(frame)->truth.inside, 0.3);
    }
}

}  // namespace
}  // namespace goalmouth
