#include "core/simulation/renderer.h"

#include "core/simulation/truth.h"
#include "tests/core/simulation/measured.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::camera_at;
using test::covered_in_column;
using test::covered_in_row;
using test::plain_scene;
using test::render_plain;
using test::still;
using test::x_at;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double wall = 20.0;
constexpr double goal = 230.0;

/// Compares both edges of the opponents' left post with its tangent planes, in rows where the wall is behind
/// it.
void expect_edges(const Intrinsics& camera, double distance, double roll, double tolerance,
                  double blur = 0.0) {
    const Field field;
    // A little off the pixel raster, the post left of the middle, the other one out of the way or far to the
    // right.
    const Eigen::Isometry3d T_WC = camera_at(3.0 - distance, 0.75 - 0.03, 0.013, 0.42, roll, -2 * degree);
    SceneParameters scene = plain_scene();
    scene.room_margin = 0.3;
    ImageFormationParameters formation = test::plain_formation();
    formation.sensor.blur = blur;
    Renderer renderer(make_scene(field, scene), camera, formation);
    Random random(1);
    const YuyvImage image = renderer.render(still(T_WC), random);
    const auto posts = true_posts(make_scene(field, scene), camera, T_WC);
    const auto found = std::find_if(posts.begin(), posts.end(), [](const TruePost& p) { return p.id == 2; });
    ASSERT_NE(found, posts.end());
    const auto bent = [&](const Eigen::Vector2d& p) {
        return pixel_from_normalised(camera,
                                     {(p.x() - camera.cx) / camera.fx, (p.y() - camera.cy) / camera.fy});
    };
    const auto edge_x = [&](const Eigen::Vector2d& top, const Eigen::Vector2d& base, double row) {
        if (!camera.has_distortion()) return x_at(top, base, row);
        double low = 0.0, high = 1.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (bent(top + middle * (base - top)).y() < row ? low : high) = middle;
        }
        return bent(top + low * (base - top)).x();
    };
    double worst = 0.0;
    int rows = 0;
    // Above the horizon and below the crossbar: the wall is behind.
    const double top = std::max(found->edges.left_top.y(), found->edges.right_top.y());
    const double length = std::min(found->edges.left_base.y(), found->edges.right_base.y()) - top;
    const int first = std::max(2, static_cast<int>(top + 0.2 * length));
    for (int row = first; row < top + 0.42 * length; ++row) {
        const double left = edge_x(found->edges.left_top, found->edges.left_base, row);
        const double right = edge_x(found->edges.right_top, found->edges.right_base, row);
        const int before = static_cast<int>(std::floor(left)) - 4;
        const int middle = static_cast<int>(std::lround(0.5 * (left + right)));
        const int after = static_cast<int>(std::ceil(right)) + 4;
        if (before < 0 || after >= camera.width) continue;
        ++rows;
        const double measured_left = middle + 0.5 - covered_in_row(image, row, before, middle, goal, wall);
        const double measured_right =
            middle + 0.5 + covered_in_row(image, row, middle + 1, after, goal, wall);
        worst = std::max({worst, std::abs(measured_left - left), std::abs(measured_right - right)});
    }
    EXPECT_GT(rows, 15);
    EXPECT_LT(worst, tolerance) << distance << " m, roll " << roll;
}

TEST(Renderer, PostEdgesLieOnTheTangentPlanes) {
    for (const double distance : {0.6, 1.5, 3.0, 6.0})
        for (const double roll : {0.0, 10 * degree, 20 * degree})
            expect_edges(Intrinsics{}, distance, roll, 0.02);
}

TEST(Renderer, BlurLeavesPostEdgesWhereTheyAre) {
    for (const double distance : {0.6, 1.5, 3.0, 6.0})
        for (const double roll : {0.0, 10 * degree, 20 * degree})
            expect_edges(Intrinsics{}, distance, roll, 0.02, 0.85);
}

TEST(Renderer, PostEdgesBendWithTheLens) {
    Intrinsics camera;
    camera.distortion = {-0.12, 0.03, 0.0, 0.0, 0.0};
    for (const double roll : {0.0, 15 * degree}) expect_edges(camera, 1.5, roll, 0.04);
}

TEST(Renderer, WidthOfAPostIsTheClosedForm) {
    for (const double distance : {0.6, 1.5, 3.0, 6.0}) {
        const Intrinsics camera;
        const YuyvImage image = render_plain(Field{}, plain_scene(), camera,
                                             camera_at(3.0 - distance, 0.75, 0.0, 0.42, 0.0, 0.0));
        const double expected = 2.0 * camera.fx * std::tan(std::asin(0.05 / distance));
        // The camera looks level at the post: in the rows about the middle, only the wall is beside it.
        const int half = static_cast<int>(expected);
        const double width = covered_in_row(image, 230, 319 - half, 319 + half, goal, wall);
        EXPECT_NEAR(width, expected, 0.02) << distance;
    }
}

TEST(Renderer, FarWallMeetsTheFloorBelowTheHorizon) {
    SceneParameters scene = plain_scene();
    scene.room_margin = 10.0;
    scene.room_height = 30.0;
    const Intrinsics camera;
    const double pitch = 8 * degree;
    const YuyvImage image = render_plain(Field{}, scene, camera, camera_at(0.0, 1.8, 0.0, 0.42, 0.0, pitch));
    const double horizon = camera.cy - camera.fy * std::tan(pitch);
    const double wall_foot = camera.cy + camera.fy * std::tan(std::atan(0.42 / 13.7) - pitch);
    const double skirting_top = camera.cy + camera.fy * std::tan(std::atan(0.32 / 13.699) - pitch);
    ASSERT_GT(wall_foot, horizon);
    const int first = static_cast<int>(horizon) - 20;
    // Skirting is darker than the floor and lighter than the wall: measure the wall's share down to it.
    const double skirting = 0.299 * 70 + 0.587 * 66 + 0.114 * 66;
    double light = 0.0;
    for (int y = first; y < first + 50; ++y) light += image.view().at(20, y).y;
    const double expected = wall * (skirting_top - (first - 0.5)) + skirting * (wall_foot - skirting_top) +
                            140.0 * (first + 49.5 - wall_foot);
    EXPECT_NEAR(light, expected, 0.05 * 120.0);
}

TEST(Renderer, CarpetEndsWhereGeometrySays) {
    const Intrinsics camera;
    const Eigen::Isometry3d T_WC = camera_at(1.0, 1.6, 0.0, 0.42, 0.0, 5 * degree);
    const YuyvImage image = render_plain(Field{}, plain_scene(), camera, T_WC);
    const auto edge = project(camera, T_WC.inverse() * Eigen::Vector3d(3.7, 1.6, 0.0));
    const auto foot = project(camera, T_WC.inverse() * Eigen::Vector3d(5.3, 1.6, 0.0));
    ASSERT_TRUE(edge && foot);
    const int first = static_cast<int>(foot->y()) + 2;
    const int last = static_cast<int>(edge->y()) + 6;
    const double floor_rows = covered_in_column(image, 320, first, last, 140.0, 60.0);
    EXPECT_NEAR(first - 0.5 + floor_rows, edge->y(), 0.06);
}

TEST(Renderer, LinesLieWhereTheLayoutPutsThem) {
    const Intrinsics camera;
    for (const double roll : {0.0, 12 * degree})
        for (const double x : {0.7, 1.4, 1.9}) {
            const Eigen::Isometry3d T_WC = camera_at(x, 0.4, 0.0, 0.42, roll, 20 * degree);
            const YuyvImage image = render_plain(Field{}, plain_scene(), camera, T_WC);
            // The goal area's front line, seen across.
            const auto edge = [&](double at, int column) {
                const Eigen::Vector2d a = *project(camera, T_WC.inverse() * Eigen::Vector3d(at, 0.5, 0.0));
                const Eigen::Vector2d b = *project(camera, T_WC.inverse() * Eigen::Vector3d(at, 0.3, 0.0));
                return a.y() + (column - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
            };
            for (const int column : {300, 320, 339}) {
                const double far = edge(2.425, column);
                const double near = edge(2.375, column);
                const double sum = covered_in_column(image, column, static_cast<int>(far) - 3,
                                                     static_cast<int>(near) + 4, 240.0, 60.0);
                EXPECT_NEAR(sum, near - far, 0.03) << x << " " << roll << " " << column;
                const int middle = static_cast<int>(std::lround(0.5 * (far + near)));
                const double below =
                    covered_in_column(image, column, middle + 1, static_cast<int>(near) + 4, 240.0, 60.0);
                EXPECT_NEAR(middle + 0.5 + below, near, 0.03) << x << " " << roll << " " << column;
            }
        }
}

TEST(Renderer, LineCrossingsAreGroundPoints) {
    const Intrinsics camera;
    // The T where the halfway line meets the left side line: its pixel is white, and so is the pixel of each
    // arm; off them green.
    const Eigen::Isometry3d T_WC = camera_at(-1.2, 1.3, 0.5, 0.42, 0.05, 0.25);
    const YuyvImage image = render_plain(Field{}, plain_scene(), camera, T_WC);
    const auto luma = [&](double x, double y) {
        const Eigen::Vector2d p = *project(camera, T_WC.inverse() * Eigen::Vector3d(x, y, 0.0));
        return static_cast<int>(
            image.view().at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))).y);
    };
    EXPECT_GT(luma(0.0, 2.0), 235);
    EXPECT_GT(luma(0.3, 2.0), 235);
    EXPECT_GT(luma(-0.3, 2.0), 235);
    EXPECT_GT(luma(0.0, 1.7), 235);
    EXPECT_EQ(luma(0.15, 1.85), 60);
    EXPECT_EQ(luma(-0.15, 1.85), 60);
    EXPECT_EQ(luma(0.0, 2.15), 60);
}

TEST(Renderer, BallIsAConeOfRays) {
    const Intrinsics camera;
    SceneParameters scene = plain_scene();
    scene.ball_on_penalty_mark = false;
    scene.ball_x = 1.0;
    scene.ball_y = 1.0;
    Field field;
    field.ball_diameter = 0.1;
    // The camera looks straight at the ball's centre.
    const double distance = 0.8;
    const double height = 0.42;
    const double pitch = std::atan((height - 0.05) / distance);
    const Eigen::Isometry3d T_WC = camera_at(1.0 - distance, 1.0, 0.0, height, 0.0, pitch);
    const YuyvImage image = render_plain(field, scene, camera, T_WC);
    const double alpha = std::asin(0.05 / std::hypot(distance, height - 0.05));
    const double radius = camera.fx * std::tan(alpha);
    double area = 0.0;
    const int reach = static_cast<int>(radius) + 5;
    for (int y = 240 - reach; y <= 240 + reach; ++y)
        area += covered_in_row(image, y, 320 - reach, 320 + reach, 250.0, 60.0);
    EXPECT_NEAR(std::sqrt(area / std::numbers::pi), radius, 0.03);
    EXPECT_NEAR(covered_in_row(image, 240, 320 - reach, 320 + reach, 250.0, 60.0),
                2.0 * std::sqrt(radius * radius - 0.25), 0.1);
}

TEST(Renderer, NearThingsHideFarOnes) {
    const Intrinsics camera;
    // Along a goal line: the near post hides the far one of the same goal.
    const Field field;
    Scene scene = make_scene(field, plain_scene());
    scene.tubes[2].colour = {100.0F, 100.0F, 100.0F};  // opponents' left, the near one
    Renderer renderer(scene, camera, test::plain_formation());
    Random random(1);
    const YuyvImage image =
        renderer.render(still(camera_at(3.0, 1.75, -90 * degree, 0.42, 0.0, 0.0)), random);
    EXPECT_EQ(image.view().at(320, 240).y, 100);
}

TEST(Renderer, CrossbarJoinsThePosts) {
    const Intrinsics camera;
    const YuyvImage image =
        render_plain(Field{}, plain_scene(), camera, camera_at(0.5, 0.0, 0.0, 0.42, 0.0, -5 * degree));
    const Eigen::Isometry3d T_WC = camera_at(0.5, 0.0, 0.0, 0.42, 0.0, -5 * degree);
    for (double y = -0.78; y <= 0.78; y += 0.01) {
        const Eigen::Vector2d p = *project(camera, T_WC.inverse() * Eigen::Vector3d(2.95, y, 0.9));
        EXPECT_EQ(
            image.view().at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))).y,
            230)
            << y;
    }
}

TEST(Renderer, LampsLightOneSideOfAPost) {
    ImageFormationParameters formation;
    formation.light.azimuth = 90 * degree;  // from +y: for a camera that looks along +x, from the left
    formation.light.limb_darkening = 0.0;
    formation.sensor = test::ideal_sensor();
    Renderer renderer(make_scene(Field{}, plain_scene()), Intrinsics{}, formation);
    Random random(1);
    const YuyvImage image = renderer.render(still(camera_at(1.5, 0.75, 0.0, 0.42, 0.0, 0.0)), random);
    EXPECT_GT(image.view().at(306, 240).y, image.view().at(320, 240).y + 5);
    EXPECT_GE(image.view().at(320, 240).y, image.view().at(334, 240).y);
}

TEST(Renderer, SameSeedSameBytes) {
    const Eigen::Isometry3d one = camera_at(-1.8, -1.5, 1.4, 0.42, 0.04, 0.2);
    const Eigen::Isometry3d other = camera_at(0.5, 0.5, 0.2, 0.42, -0.03, 0.15);
    const auto frame = [&](Renderer& renderer, const Eigen::Isometry3d& T_WC, std::int64_t seq) {
        Random random = random_for_frame(7, "simulator", seq);
        return renderer.render(still(T_WC), random).data;
    };
    Renderer a(make_scene(Field{}, {}), Intrinsics{});
    Renderer b(make_scene(Field{}, {}), Intrinsics{});
    const auto first = frame(a, one, 0);
    frame(b, other, 5);  // what was rendered before leaves no trace
    EXPECT_EQ(first, frame(b, one, 0));
    EXPECT_NE(first, frame(b, one, 1));
}

TEST(Renderer, AnyPoseAboveTheGroundGivesAFrame) {
    Random random(3);
    Intrinsics camera = from_horizontal_fov(161, 77, 1.2);  // an odd width holds half a pair more
    camera.distortion = {-0.1, 0.02, 0.001, 0.001, 0.0};
    Renderer renderer(make_scene(Field{}, {}), camera);
    for (int i = 0; i < 300; ++i) {
        const Eigen::Isometry3d T_WC =
            camera_at(random.uniform(-4, 4), random.uniform(-3, 3), random.uniform(-3, 3),
                      random.uniform(0.01, 2.5), random.uniform(-3, 3), random.uniform(-1.5, 1.5));
        const YuyvImage image = renderer.render(still(T_WC), random);
        ASSERT_EQ(image.data.size(), 162U * 2U * 77U);
    }
}

TEST(Scene, AColourIsThreeLevels) {
    SceneParameters p;
    p.carpet = {1, 2};
    EXPECT_THROW(make_scene(Field{}, p), std::invalid_argument);
}

}  // namespace
}  // namespace goalmouth
