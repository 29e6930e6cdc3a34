#include "core/simulation/robot.h"

#include "core/simulation/painting_order.h"
#include "tests/core/simulation/hall_support.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::camera_at;
using test::covered_by;
using test::LightImage;
using test::plain_scene;

constexpr double degree = std::numbers::pi / 180.0;

Scene empty_hall() {
    SceneParameters p = plain_scene();
    p.ball_on_penalty_mark = false;
    p.ball_x = -3.5;
    Scene scene = make_scene(Field{}, p);
    scene.tubes.clear();
    return scene;
}

std::vector<Tube> robot_at(const RobotPlace& place) {
    Scene scene = empty_hall();
    add_robot(scene, place);
    return scene.tubes;
}

struct Extent {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = Eigen::Vector3d::Constant(-1e9);
};

Extent extent(const std::vector<Tube>& tubes) {
    Extent e;
    for (const Tube& tube : tubes) {
        const Cylinder& c = tube.cylinder;
        for (int axis = 0; axis < 3; ++axis) {
            const double side = c.radius * std::sqrt(std::max(0.0, 1.0 - c.axis[axis] * c.axis[axis]));
            e.low[axis] = std::min({e.low[axis], c.base[axis] - side, c.top()[axis] - side});
            e.high[axis] = std::max({e.high[axis], c.base[axis] + side, c.top()[axis] + side});
        }
    }
    return e;
}

TEST(Robot, StandsOnTheGroundAtItsHeight) {
    for (const double height : {0.3, 0.4545, 0.6}) {
        const Extent e = extent(robot_at({{1.0, 0.5, 0.7}, false, height, {}}));
        EXPECT_NEAR(e.low.z(), 0.0, 1e-9);
        EXPECT_NEAR(e.high.z(), height, 1e-9);
        EXPECT_GT(e.low.x(), 1.0 - height / 3.0);
        EXPECT_LT(e.high.x(), 1.0 + height / 3.0);
        EXPECT_GT(e.low.y(), 0.5 - height / 3.0);
        EXPECT_LT(e.high.y(), 0.5 + height / 3.0);
    }
}

TEST(Robot, LiesOnTheGroundAtItsLength) {
    const Extent e = extent(robot_at({{1.0, 0.5, std::numbers::pi / 2.0}, true, 0.45, {}}));
    EXPECT_NEAR(e.low.z(), 0.0, 1e-9);
    EXPECT_LT(e.high.z(), 0.15);
    EXPECT_NEAR(e.low.y(), 0.5 - 0.225, 1e-9);
    EXPECT_NEAR(e.high.y(), 0.5 + 0.225, 1e-9);
    EXPECT_NEAR(0.5 * (e.low.x() + e.high.x()), 1.0, 1e-9);
}

TEST(Robot, WearsItsJersey) {
    const auto tubes = robot_at({{}, false, 0.45, {1.0F, 2.0F, 3.0F}});
    EXPECT_EQ(tubes.size(), 17U);
    EXPECT_EQ(std::count_if(tubes.begin(), tubes.end(), [](const Tube& t) { return t.colour.b == 3.0F; }), 1);
    for (const Tube& tube : tubes) EXPECT_EQ(tube.of, Tube::Of::robot);
}

TEST(Robots, KeepTheirDistance) {
    for (int seed = 0; seed < 20; ++seed) {
        SceneParameters p;
        p.robots = 8;
        p.clutter_seed = seed;
        const Scene scene = make_scene(Field{}, p);
        std::vector<Eigen::Vector2d> middles;
        std::vector<Tube> robots;
        for (const Tube& tube : scene.tubes)
            if (tube.of == Tube::Of::robot) robots.push_back(tube);
        ASSERT_EQ(robots.size(), 8U * 17U);
        for (std::size_t i = 0; i < robots.size(); i += 17) {
            const std::vector<Tube> one(robots.begin() + static_cast<std::ptrdiff_t>(i),
                                        robots.begin() + static_cast<std::ptrdiff_t>(i) + 17);
            const Extent e = extent(one);
            middles.emplace_back(0.5 * (e.low + e.high).head<2>());
            EXPECT_LT(std::abs(middles.back().x()), 3.1);
            EXPECT_LT(std::abs(middles.back().y()), 2.1);
        }
        // Middles of what stands, so a little more than the places they were drawn for.
        for (std::size_t i = 0; i < middles.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) EXPECT_GT((middles[i] - middles[k]).norm(), 0.55);
            for (const Cylinder& post : scene.posts)
                EXPECT_GT((middles[i] - post.base.head<2>()).norm(), 0.55);
        }
    }
}

TEST(Robots, AreAsManyAsFindRoom) {
    Field field;
    field.length = 1.5;
    field.width = 1.0;
    SceneParameters p;
    p.robots = 20;
    const Scene scene = make_scene(field, p);
    const auto parts = std::count_if(scene.tubes.begin(), scene.tubes.end(),
                                     [](const Tube& t) { return t.of == Tube::Of::robot; });
    EXPECT_LT(parts, 20 * 17);
    EXPECT_EQ(parts % 17, 0);
}

/// Compares both sides of a tube, painted alone, with its tangent planes, in rows or columns, whichever cross
/// it more squarely. Returns how many were compared.
int expect_sides(const Tube& tube, const RayTable& rays, const Eigen::Isometry3d& T_WC) {
    const Intrinsics& camera = rays.camera();
    const auto edges = project_edges(camera, T_WC, tube.cylinder);
    if (!edges) return 0;
    const LightImage share = covered_by(tube, rays, T_WC);
    const bool upright = std::abs(edges->left_top.y() - edges->left_base.y()) >
                         std::abs(edges->left_top.x() - edges->left_base.x());
    const auto flip = [&](const Eigen::Vector2d& p) { return upright ? p : Eigen::Vector2d(p.y(), p.x()); };
    const Eigen::Vector2d a0 = flip(edges->left_base), a1 = flip(edges->left_top);
    const Eigen::Vector2d b0 = flip(edges->right_base), b1 = flip(edges->right_top);
    const int count = upright ? camera.height : camera.width;
    const int across = upright ? camera.width : camera.height;
    const auto sum = [&](int line, int first, int last) {
        return upright ? share.row(line, first, last) : share.column(line, first, last);
    };
    // Away from the ends, whose outlines are ellipses.
    const double low = std::max(std::min(a0.y(), a1.y()), std::min(b0.y(), b1.y()));
    const double high = std::min(std::max(a0.y(), a1.y()), std::max(b0.y(), b1.y()));
    const double width = std::abs(test::x_at(a0, a1, low) - test::x_at(b0, b1, low));
    double worst = 0.0;
    int compared = 0;
    for (int line = static_cast<int>(std::max(0.0, low + width + 2.0));
         line < std::min(high - width - 2.0, count - 1.0); ++line) {
        const double one = test::x_at(a0, a1, line), other = test::x_at(b0, b1, line);
        const double first = std::min(one, other), last = std::max(one, other);
        const int before = static_cast<int>(first) - 4, after = static_cast<int>(last) + 4;
        if (before < 0 || after >= across) continue;
        const int middle = static_cast<int>(std::lround(0.5 * (first + last)));
        worst = std::max({worst, std::abs(middle + 0.5 - sum(line, before, middle) - first),
                          std::abs(middle + 0.5 + sum(line, middle + 1, after) - last)});
        ++compared;
    }
    if (compared > 0) {
        EXPECT_LT(worst, 0.02) << tube.cylinder.radius << " " << tube.cylinder.length;
    }
    return compared;
}

TEST(Robot, SidesOfItsPartsLieOnTheTangentPlanes) {
    const RayTable rays{Intrinsics{}};
    int compared = 0;
    for (const bool fallen : {false, true})
        for (const double distance : {0.4, 1.0, 3.0})
            for (const double roll : {0.0, 17 * degree}) {
                const Eigen::Isometry3d T_WC =
                    camera_at(1.0, 0.0, 0.02, 0.42, roll, std::atan(0.2 / distance));
                for (const Tube& tube : robot_at({{1.0 + distance, 0.0, 1.1}, fallen, 0.45, {}}))
                    compared += expect_sides(tube, rays, T_WC);
            }
    EXPECT_GT(compared, 400);
}

TEST(LyingCylinder, SidesLieOnTheTangentPlanes) {
    const RayTable rays{Intrinsics{}};
    for (const double distance : {0.6, 1.5, 3.0, 6.0})
        for (const double turn : {90 * degree, 60 * degree, 25 * degree})
            for (const double roll : {0.0, 10 * degree, 20 * degree}) {
                const Eigen::Vector3d run(std::cos(turn), std::sin(turn), 0.0);
                const Eigen::Vector3d middle(distance - 2.0, 0.1, 0.05);
                const Tube tube{cylinder_between(middle - 0.4 * run, middle + 0.4 * run, 0.05), {}};
                const Eigen::Isometry3d T_WC =
                    camera_at(-2.0, 0.1, 0.01, 0.42, roll, std::atan(0.37 / distance));
                EXPECT_GT(expect_sides(tube, rays, T_WC), 5) << distance << " " << turn << " " << roll;
            }
}

/// Which tube the ray through each pixel meets first; −1 none. Pixels beside another tube's are left out: −2.
std::vector<int> first_met(const Scene& scene, const Intrinsics& camera, const Eigen::Isometry3d& T_WC) {
    const int w = camera.width, h = camera.height;
    std::vector<int> met(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), -1);
    const auto at = [&](int x, int y) -> int& {
        return met[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const Eigen::Vector2d n = normalised_from_pixel(camera, Eigen::Vector2d(x, y));
            const Eigen::Vector3d ray = T_WC.linear() * Eigen::Vector3d(n.x(), n.y(), 1.0);
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < scene.tubes.size(); ++i) {
                const auto t = test::meets_solid(scene.tubes[i].cylinder, T_WC.translation(), ray);
                if (t && *t < nearest) {
                    nearest = *t;
                    at(x, y) = static_cast<int>(i);
                }
            }
        }
    std::vector<int> clear = met;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    if (y + dy < 0 || y + dy >= h || x + dx < 0 || x + dx >= w ||
                        at(x + dx, y + dy) != at(x, y))
                        clear[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                              static_cast<std::size_t>(x)] = -2;
    return clear;
}

struct Mistakes {
    int compared = 0;
    int wrong = 0;
};

/// How many pixels show another tube than the one their ray meets first.
Mistakes painted_wrongly(Scene scene, const Intrinsics& camera, const Eigen::Isometry3d& T_WC) {
    for (std::size_t i = 0; i < scene.tubes.size(); ++i) {
        const auto level = static_cast<float>(250 - i);
        scene.tubes[i].colour = {level, level, level};
    }
    Renderer renderer(scene, camera, test::plain_formation());
    Random random(1);
    const YuyvImage image = renderer.render(test::still(T_WC), random);
    const auto met = first_met(scene, camera, T_WC);
    Mistakes result;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const int tube = met[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                                 static_cast<std::size_t>(x)];
            if (tube < 0) continue;
            ++result.compared;
            if (std::abs(image.view().at(x, y).y - (250 - tube)) > 1) ++result.wrong;
        }
    return result;
}

TEST(PaintingOrder, RobotsBeforeAndBehindAPostComeOutRight) {
    // Post and robots stand closer together than any is high, where distances of whole things say little.
    Random random(11);
    const Intrinsics camera = scaled_to(Intrinsics{}, 160, 120);
    int compared = 0;
    for (int i = 0; i < 60; ++i) {
        Scene scene = empty_hall();
        scene.tubes.push_back({scene.posts[2], {}});
        for (const double away : {0.17, -0.17}) {
            RobotPlace place;
            place.fallen = random.uniform() < 0.3;
            place.height = 0.45;
            const double turn = random.uniform(-3.0, 3.0);
            const double room = place.fallen ? 0.35 : std::abs(away);
            place.pose = {3.0 + std::copysign(room, away), 0.75 + random.uniform(-0.1, 0.1), turn};
            add_robot(scene, place);
        }
        const double distance = random.uniform(0.5, 3.0);
        const double way = random.uniform(-3.0, 3.0);
        const double height = random.uniform(0.3, 0.9);
        const Eigen::Isometry3d T_WC =
            camera_at(3.0 - distance * std::cos(way), 0.75 - distance * std::sin(way), way, height,
                      random.uniform(-0.3, 0.3), std::atan((height - 0.2) / distance));
        const Mistakes m = painted_wrongly(scene, camera, T_WC);
        compared += m.compared;
        EXPECT_LE(m.wrong, m.compared / 100) << i;
    }
    EXPECT_GT(compared, 50000);
}

TEST(PaintingOrder, AFootBeforeAPostIsPaintedOverIt) {
    // The foot lies on the ground, 0.42 m below the camera; the post reaches up to it and is nearer to it.
    Scene scene = empty_hall();
    const Cylinder post{{0.57, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.95, 0.05};
    const Cylinder foot = cylinder_between({0.45, -0.1, 0.05}, {0.45, 0.1, 0.05}, 0.05);
    scene.tubes = {{post, {}}, {foot, {}}};
    ASSERT_GT(Eigen::Vector3d(0.45, 0.0, 0.05 - 0.42).norm(), 0.57);
    const Mistakes m = painted_wrongly(scene, Intrinsics{}, camera_at(0.0, 0.0, 0.0, 0.42, 0.0, 30 * degree));
    EXPECT_GT(m.compared, 1000);
    EXPECT_EQ(m.wrong, 0);
}

TEST(Hiding, IsToldByAPlaneBetweenTheBodies) {
    const auto body = [](double z, double x) { return SeenBody{{x, -1.0, z}, {x, 1.0, z}, 0.1}; };
    EXPECT_EQ(hiding(body(1.0, 0.0), body(2.0, 0.0)), Hiding::by_first);
    EXPECT_EQ(hiding(body(2.0, 0.0), body(1.0, 0.0)), Hiding::by_second);
    EXPECT_EQ(hiding(body(1.0, -0.5), body(1.0, 0.5)), Hiding::none);       // on either side of the camera
    EXPECT_EQ(hiding(body(1.15, 0.0), body(1.0, 0.0)), Hiding::by_second);  // they overlap
    EXPECT_EQ(hiding(body(1.0, 0.0), body(1.02, 0.0)), Hiding::unclear);
    const SeenBody point{{0.0, 0.0, 3.0}, {0.0, 0.0, 3.0}, 0.1};
    EXPECT_EQ(hiding(point, body(1.0, 0.0)), Hiding::by_second);
    EXPECT_EQ(hiding(point, point), Hiding::unclear);
}

}  // namespace
}  // namespace goalmouth
