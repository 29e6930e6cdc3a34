#include "core/process/configuration.h"
#include "core/simulation/scene.h"
#include "core/simulation/truth.h"
#include "tests/core/simulation/hall_support.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::camera_at;
using test::covered_in_row;
using test::plain_scene;
using test::x_at;

constexpr double degree = std::numbers::pi / 180.0;

Field shipped_field(const std::string& name) {
    return load_parameters<Field>(std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config/fields" / name);
}

/// Where a post's edges lie in rendered frames, at the paper's distances and tilts, against its tangent
/// planes.
void expect_post_edges(const Field& field) {
    constexpr double wall = 20.0, goal = 230.0;
    SceneParameters p = plain_scene();
    p.white_goal = {230, 230, 230};
    p.own_goal = false;
    p.room_margin = 0.3;
    p.room_height = 12.0;  // behind the whole post
    const Scene scene = make_scene(field, p);
    const Intrinsics camera;
    Renderer renderer(scene, camera, test::plain_formation());
    Random random(1);
    for (const double distance : {0.6, 1.5, 3.0, 3.5, 5.3, 6.0})
        for (const double tilt : {0.0, 10 * degree, 20 * degree}) {
            // In line with the right post, a little off the pixel raster.
            const Eigen::Isometry3d T_WC =
                camera_at(0.5 * field.length - distance, -0.5 * field.goal_width - 0.03, 0.013, 0.42, tilt,
                          -2 * degree);
            const YuyvImage image = renderer.render(test::still(T_WC), random);
            const auto posts = true_posts(scene, camera, T_WC);
            const auto post =
                std::find_if(posts.begin(), posts.end(), [](const TruePost& t) { return t.id == 3; });
            ASSERT_NE(post, posts.end());
            const CylinderEdges& e = post->edges;
            double worst = 0.0;
            int rows = 0;
            // The wall is behind from a little above the camera's height up to the bar.
            const auto height_at = [&](double share) {
                return e.left_base.y() + share * (e.left_top.y() - e.left_base.y());
            };
            const double low = 0.6 / scene.posts[3].length;
            const double high = (field.goal_height - 0.3) / scene.posts[3].length;
            for (int row = std::max(1, static_cast<int>(height_at(std::max(low + 0.05, high))));
                 row < std::min(camera.height - 1.0, height_at(low)); ++row) {
                const double left = x_at(e.left_top, e.left_base, row);
                const double right = x_at(e.right_top, e.right_base, row);
                const int before = static_cast<int>(std::floor(left)) - 4;
                const int middle = static_cast<int>(std::lround(0.5 * (left + right)));
                const int after = static_cast<int>(std::ceil(right)) + 4;
                if (before < 0 || after >= camera.width) continue;
                ++rows;
                worst = std::max(
                    {worst,
                     std::abs(middle + 0.5 - covered_in_row(image, row, before, middle, goal, wall) - left),
                     std::abs(middle + 0.5 + covered_in_row(image, row, middle + 1, after, goal, wall) -
                              right)});
            }
            EXPECT_GE(rows, 3) << field.name << " " << distance << " " << tilt;
            EXPECT_LT(worst, 0.02) << field.name << " " << distance << " " << tilt;
        }
}

TEST(PostEdges, LieOnTheTangentPlanesOnTheFieldOf2013) {
    expect_post_edges(shipped_field("kidsize_2013.yaml"));
}
TEST(PostEdges, LieOnTheTangentPlanesOnTheWhiteField) {
    expect_post_edges(shipped_field("humanoid_white.yaml"));
}

std::size_t count(const Scene& scene, Tube::Of of) {
    return static_cast<std::size_t>(
        std::count_if(scene.tubes.begin(), scene.tubes.end(), [&](const Tube& t) { return t.of == of; }));
}

TEST(Scene, WithoutTheOwnGoalOnlyTheOtherStands) {
    SceneParameters p;
    const Scene both = make_scene(Field{}, p);
    p.own_goal = false;
    const Scene one = make_scene(Field{}, p);
    EXPECT_EQ(count(both, Tube::Of::goal), 2U * count(one, Tube::Of::goal));
    for (const Tube& tube : one.tubes) {
        if (tube.of != Tube::Of::goal) continue;
        EXPECT_GT(tube.cylinder.base.x(), 2.9);
        EXPECT_GT(tube.cylinder.top().x(), 2.9);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(both.stands(i));
        EXPECT_EQ(one.stands(i), i >= 2);
        EXPECT_EQ(one.posts[i].base, both.posts[i].base);  // numbered as ever
        for (const Scene* scene : {&both, &one})
            EXPECT_EQ(std::count_if(scene->tubes.begin(), scene->tubes.end(),
                                    [&](const Tube& t) {
                                        return t.post == static_cast<int>(i) &&
                                               t.cylinder.base == scene->posts[i].base;
                                    }),
                      scene->stands(i) ? 1 : 0);
    }
}

TEST(Scene, AddedThingsLeaveTheOthersWhereTheyAre) {
    SceneParameters p;
    const Scene bare = make_scene(Field{}, p);
    p.distractors = 9;
    p.robots = 3;
    const Scene full = make_scene(Field{}, p);
    ASSERT_GT(full.tubes.size(), bare.tubes.size());
    for (std::size_t i = 0; i < bare.tubes.size(); ++i) {
        EXPECT_EQ(full.tubes[i].cylinder.base, bare.tubes[i].cylinder.base);
        EXPECT_EQ(full.tubes[i].colour.r, bare.tubes[i].colour.r);
    }
    ASSERT_EQ(full.panels.size(), bare.panels.size() + 3);
    for (std::size_t i = 0; i < bare.panels.size(); ++i)
        EXPECT_EQ(full.panels[i].corners, bare.panels[i].corners);
}

TEST(Scene, DistractorsLookLikeGoalsAndStandBeyondTheCarpet) {
    for (const char* colour : {"yellow", "white"}) {
        Field field;
        field.goal_colour = colour;
        SceneParameters p;
        p.posters = 0;
        p.spectators = 0;
        p.distractors = 30;
        const Scene scene = make_scene(field, p);
        const Rgb goal = scene.tubes[0].colour;
        const auto like = [&](const Rgb& c) {
            return std::abs(c.r - goal.r) < 40.0F && std::abs(c.g - goal.g) < 40.0F &&
                   std::abs(c.b - goal.b) < 40.0F;
        };
        std::size_t alike = 0;
        for (const Tube& tube : scene.tubes) {
            if (tube.of != Tube::Of::hall) continue;
            if (like(tube.colour)) ++alike;
            const Eigen::Vector3d& foot = tube.cylinder.base;
            EXPECT_TRUE(std::abs(foot.x()) > scene.layout.carpet_half_length + 0.2 ||
                        std::abs(foot.y()) > scene.layout.carpet_half_width + 0.2);
        }
        EXPECT_GE(alike, 20U) << colour;  // poles and shirts, and what else is white
        EXPECT_EQ(scene.panels.size(), 8U + 10U);
        for (std::size_t i = 8; i < scene.panels.size(); ++i) EXPECT_TRUE(like(scene.panels[i].colour)) << i;
    }
}

TEST(Scene, AnyColourMayBeTheGoalsOrTheCarpets) {
    SceneParameters p;
    p.posters = 200;
    const auto near = [](const Rgb& c, const std::vector<double>& to) {
        return std::hypot(c.r - static_cast<float>(to[0]), c.g - static_cast<float>(to[1]),
                          c.b - static_cast<float>(to[2])) < 45.0F;
    };
    const auto found = [&](const std::vector<double>& to) {
        for (p.clutter_seed = 0; p.clutter_seed < 10; ++p.clutter_seed) {
            const Scene scene = make_scene(Field{}, p);
            if (std::any_of(scene.panels.begin(), scene.panels.end(),
                            [&](const Panel& panel) { return near(panel.colour, to); }))
                return true;
        }
        return false;
    };
    EXPECT_FALSE(found(p.yellow_goal));
    EXPECT_FALSE(found(p.carpet));
    p.any_colour = true;
    EXPECT_TRUE(found(p.yellow_goal));
    EXPECT_TRUE(found(p.carpet));
}

TEST(Scene, ASeedIsAScene) {
    SceneParameters p;
    p.distractors = 5;
    p.robots = 4;
    p.any_colour = true;
    const Scene a = make_scene(Field{}, p);
    const Scene b = make_scene(Field{}, p);
    p.clutter_seed = 8;
    const Scene c = make_scene(Field{}, p);
    ASSERT_EQ(a.tubes.size(), b.tubes.size());
    std::size_t moved = 0;
    for (std::size_t i = 0; i < a.tubes.size(); ++i) {
        EXPECT_EQ(a.tubes[i].cylinder.base, b.tubes[i].cylinder.base);
        EXPECT_EQ(a.tubes[i].colour.g, b.tubes[i].colour.g);
        if (i < c.tubes.size() && a.tubes[i].cylinder.base != c.tubes[i].cylinder.base) ++moved;
    }
    EXPECT_EQ(moved, c.tubes.size() - count(c, Tube::Of::goal));
}

TEST(Tube, SideAndEndJoinWithoutASeam) {
    // A cylinder seen from above: no pixel within its outline may show what is behind.
    const RayTable rays{Intrinsics{}};
    const Tube tube{{{0.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.3, 0.1}, {}};
    for (const double height : {0.35, 0.42, 0.9}) {
        const Eigen::Isometry3d T_WC =
            camera_at(-0.8, 0.02, 0.0, height, 0.1, std::atan((height - 0.2) / 0.8));
        const test::LightImage share = test::covered_by(tube, rays, T_WC);
        const Eigen::Vector3d eye = T_WC.translation();
        const auto inside = [&](double x, double y) {
            const Eigen::Vector2d n = normalised_from_pixel(rays.camera(), {x, y});
            return test::meets_solid(tube.cylinder, eye, T_WC.linear() * Eigen::Vector3d(n.x(), n.y(), 1.0))
                .has_value();
        };
        int compared = 0;
        for (int y = 2; y < 478; ++y)
            for (int x = 2; x < 638; ++x)
                if (inside(x - 1.5, y) && inside(x + 1.5, y) && inside(x, y - 1.5) && inside(x, y + 1.5)) {
                    ++compared;
                    ASSERT_GT(share.at(x, y), 0.9) << x << " " << y;
                }
        EXPECT_GT(compared, 5000);
    }
}

}  // namespace
}  // namespace goalmouth
