#include "core/simulation/shadow.h"

#include "tests/core/simulation/hall_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::camera_at;
using test::LightImage;
using test::lost_light;
using test::plain_scene;

constexpr double degree = std::numbers::pi / 180.0;

LightParameters lamps(double azimuth, double elevation, double size) {
    LightParameters p;
    p.azimuth = azimuth;
    p.elevation = elevation;
    p.lamp_size = size;
    p.shadows = true;
    return p;
}

/// A hall in which only these cast shadows; the ball, which cannot be left out, lies behind the own goal.
Scene only(const std::vector<Cylinder>& cylinders) {
    SceneParameters p = plain_scene();
    p.ball_on_penalty_mark = false;
    p.ball_x = -3.5;
    Scene scene = make_scene(Field{}, p);
    scene.tubes.clear();
    for (const Cylinder& c : cylinders) scene.tubes.push_back({c, {}});
    return scene;
}

const Cylinder post{{1.5, 1.3, 0.0}, Eigen::Vector3d::UnitZ(), 0.95, 0.05};

Footprint point(const Eigen::Vector2d& p) {
    constexpr float tiny = 1e-6F;
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), tiny, 0.0F, 0.0F, tiny};
}

TEST(Shadow, IsWhereTheLampsAreHidden) {
    Random random(4);
    int dark = 0, bright = 0;
    for (int i = 0; i < 200; ++i) {
        const Light light(lamps(random.uniform(-3, 3), random.uniform(0.4, 1.5), 0.0));
        const Eigen::Vector3d from(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.05, 0.6));
        const Eigen::Vector3d to = from + Eigen::Vector3d(random.uniform(-0.5, 0.5),
                                                          random.uniform(-0.5, 0.5), random.uniform(0, 0.5));
        const Cylinder cylinder = cylinder_between(from, to, random.uniform(0.01, 0.08));
        const Shadow shadow(cylinder, light);
        const auto hidden = [&](double x, double y) {
            return test::meets_solid(cylinder, {x, y, 0.0}, light.lamps()).has_value();
        };
        for (int k = 0; k < 300; ++k) {
            const Eigen::Vector2d middle = 0.5 * (shadow.from() + shadow.to());
            const double reach = shadow.reach() + 0.5 * (shadow.to() - shadow.from()).norm();
            const double x = middle.x() + reach * random.uniform(-1, 1);
            const double y = middle.y() + reach * random.uniform(-1, 1);
            const bool is_hidden = hidden(x, y);
            constexpr double rim = 0.0006;  // m: single precision, and ellipses seen edge on
            if (hidden(x - rim, y) != is_hidden || hidden(x + rim, y) != is_hidden ||
                hidden(x, y - rim) != is_hidden || hidden(x, y + rim) != is_hidden)
                continue;
            ++(is_hidden ? dark : bright);
            ASSERT_EQ(shadow.share(point({x, y})), is_hidden ? 1.0F : 0.0F) << i << " " << x << " " << y;
        }
    }
    EXPECT_GT(dark, 5000);
    EXPECT_GT(bright, 5000);
}

TEST(Shadow, OfABallIsAnEllipse) {
    const double elevation = 0.8;
    const Light light(lamps(0.0, elevation, 0.0));  // falls towards −x
    const double r = 0.07;
    const Shadow shadow(Ball{{1.0, 0.5, 0.4}, r, {}}, light);
    const Eigen::Vector2d centre(1.0 - 0.4 / std::tan(elevation), 0.5);
    for (int i = 0; i < 100; ++i) {
        const double a = 2.0 * std::numbers::pi * i / 100.0;
        const Eigen::Vector2d rim(r / std::sin(elevation) * std::cos(a), r * std::sin(a));
        EXPECT_EQ(shadow.share(point(centre + 0.999 * rim)), 1.0F) << i;
        EXPECT_EQ(shadow.share(point(centre + 1.001 * rim)), 0.0F) << i;
    }
}

TEST(Shadow, StripOfALeaningCylinderHasTheClosedFormWidth) {
    const Light light(lamps(0.7, 0.9, 0.0));
    const Cylinder cylinder = cylinder_between({0, 0, 0.2}, {0.3, -0.4, 0.7}, 0.04);
    const Shadow shadow(cylinder, light);
    const Eigen::Vector3d normal = cylinder.axis.cross(light.lamps()).normalized();
    const double half = 0.04 / normal.head<2>().norm();
    const Eigen::Vector2d middle = 0.5 * (shadow.from() + shadow.to());
    const Eigen::Vector2d run = (shadow.to() - shadow.from()).normalized();
    const Eigen::Vector2d across(-run.y(), run.x());
    for (const double side : {-1.0, 1.0}) {
        EXPECT_EQ(shadow.share(point(middle + side * (half - 1e-4) * across)), 1.0F);
        EXPECT_EQ(shadow.share(point(middle + side * (half + 1e-4) * across)), 0.0F);
    }
}

/// Compares both edges of a post's shadow with their projections, in columns that cross it.
void expect_edges(const LightParameters& light, const RayTable& rays, const Eigen::Isometry3d& T_WC) {
    const Intrinsics& camera = rays.camera();
    const LightImage lost = lost_light(only({post}), light, rays, T_WC);
    const Eigen::Vector3d towards = Light(light).lamps();
    const Eigen::Vector2d along =
        -towards.head<2>() / towards.z();  // of the shadow, for each metre of height
    const Eigen::Vector2d across = Eigen::Vector2d(-along.y(), along.x()).normalized();
    const auto pixel = [&](double height, double side) {
        const Eigen::Vector2d p = post.base.head<2>() + height * along + side * post.radius * across;
        return *project(camera, T_WC.inverse() * Eigen::Vector3d(p.x(), p.y(), 0.0));
    };
    const auto row_at = [&](double side, double column) {
        const Eigen::Vector2d a = pixel(0.1, side), b = pixel(0.85, side);
        return a.y() + (column - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
    };
    double left = -0.5, right = camera.width - 0.5;
    for (const double side : {-1.0, 1.0}) {
        left = std::max(left, std::min(pixel(0.1, side).x(), pixel(0.85, side).x()));
        right = std::min(right, std::max(pixel(0.1, side).x(), pixel(0.85, side).x()));
    }
    int columns = 0;
    double worst = 0.0;
    for (int u = static_cast<int>(left) + 4; u < right - 4; ++u) {
        const double top = std::min(row_at(-1.0, u), row_at(1.0, u));
        const double bottom = std::max(row_at(-1.0, u), row_at(1.0, u));
        const int first = static_cast<int>(top) - 6;
        const int middle = static_cast<int>(std::lround(0.5 * (top + bottom)));
        const int last = static_cast<int>(bottom) + 6;
        ASSERT_TRUE(first >= 0 && last < camera.height);
        ++columns;
        worst = std::max({worst, std::abs(middle + 0.5 - lost.column(u, first, middle) - top),
                          std::abs(middle + 0.5 + lost.column(u, middle + 1, last) - bottom)});
    }
    EXPECT_GT(columns, 40);
    EXPECT_LT(worst, 0.03) << light.azimuth << " " << light.elevation;
}

TEST(ShadowOnTheGround, EdgesLieWhereGeometryPutsThem) {
    const RayTable rays{Intrinsics{}};
    for (const double azimuth : {70 * degree, 100 * degree, -80 * degree})
        for (const double elevation : {0.7, 1.05})
            for (const double distance : {0.8, 1.5, 2.5})
                expect_edges(lamps(azimuth, elevation, 0.0), rays,
                             camera_at(1.5 - distance, 1.3, 0.0, 0.42, 5 * degree * distance, 15 * degree));
}

TEST(ShadowOnTheGround, ReceivesTheAmbientLightAlone) {
    LightParameters light = lamps(90 * degree, 0.9, 0.0);
    const Intrinsics camera;
    const RayTable rays(camera);
    const Eigen::Isometry3d T_WC = camera_at(0.5, 1.0, 0.0, 0.42, 0.0, 20 * degree);
    const Scene scene = only({post});
    const Eigen::Vector2d p =
        *project(camera, T_WC.inverse() * Eigen::Vector3d(1.5, 1.3 - 0.4 / std::tan(light.elevation), 0.0));
    const auto level = [&](bool shadows) {
        light.shadows = shadows;
        GroundPainter painter(scene, Light(light), camera);
        painter.look(T_WC);
        return test::painted(rays,
                             [&](int, const RowRays& row, const LightRow& out) { painter.paint(row, out); })
            .at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    };
    const double expected = light.ambient / (light.ambient + light.directional * std::sin(light.elevation));
    EXPECT_NEAR(level(true) / level(false), expected, 1e-5);
}

TEST(ShadowOnTheGround, EdgesAreRampsAsWideAsTheLamps) {
    // The post's shadow falls along −y, so that its edges run across the camera's view: at h up the post, the
    // light has come size × h / sin(elevation) apart.
    const LightParameters light = lamps(90 * degree, 0.8, 0.08);
    const Intrinsics camera;
    const RayTable rays(camera);
    const Eigen::Isometry3d T_WC = camera_at(0.6, 1.0, 0.0, 0.42, 0.0, 22 * degree);
    const LightImage lost = lost_light(only({post}), light, rays, T_WC);
    int compared = 0, half = 0;
    for (int v = 0; v < camera.height; ++v)
        for (int u = 0; u < camera.width; ++u) {
            const auto ground = ground_point(camera, T_WC, Eigen::Vector2d(u, v));
            if (!ground) continue;
            const double height = (1.3 - ground->y()) * std::tan(light.elevation);
            if (height < 0.15 || height > 0.8) continue;
            const double width = light.lamp_size * height / std::sin(light.elevation);
            const auto ramp = [&](double inside) { return std::clamp(0.5 + inside / width, 0.0, 1.0); };
            const double off = ground->x() - 1.5;
            const double expected = std::max(0.0, ramp(0.05 - off) + ramp(0.05 + off) - 1.0);
            if (std::abs(off) > 0.3) continue;
            ++compared;
            if (expected > 0.2 && expected < 0.8) ++half;
            // A pixel is 5 mm deep there, at most: rounded where the ramp begins and ends.
            ASSERT_NEAR(lost.at(u, v), expected, 0.03) << u << " " << v;
        }
    EXPECT_GT(compared, 10000);
    EXPECT_GT(half, 1000);
}

TEST(ShadowOnTheGround, TheEndOfAShadowIsStretchedWhereLightFallsFlat) {
    const LightParameters p = lamps(180 * degree, 0.6, 0.03);
    const Shadow shadow(post, Light(p));
    const double tip = 1.5 + 0.05 + 0.95 / std::tan(p.elevation);
    const double width = p.lamp_size * 0.95 / std::sin(p.elevation) / std::sin(p.elevation);
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9})
        EXPECT_NEAR(shadow.share(point({tip + (0.5 - share) * width, 1.3})), share, 0.001);
    EXPECT_EQ(shadow.share(point({tip + 0.51 * width, 1.3})), 0.0F);
}

TEST(ShadowOnTheGround, OverlappingShadowsDoNotDarkenTwice) {
    const LightParameters light = lamps(90 * degree, 0.8, 0.05);
    const Cylinder bar = cylinder_between({1.0, 1.0, 0.3}, {2.0, 1.0, 0.3}, 0.05);
    const Intrinsics camera;
    const RayTable rays(camera);
    const Eigen::Isometry3d T_WC = camera_at(0.6, 1.0, 0.0, 0.42, 0.0, 20 * degree);
    const LightImage both = lost_light(only({post, bar}), light, rays, T_WC);
    const LightImage one = lost_light(only({post}), light, rays, T_WC);
    const LightImage other = lost_light(only({bar}), light, rays, T_WC);
    int overlapping = 0;
    for (std::size_t i = 0; i < both.light.size(); ++i) {
        ASSERT_NEAR(both.light[i], std::max(one.light[i], other.light[i]), 1e-5F);
        if (one.light[i] > 0.99F && other.light[i] > 0.99F) ++overlapping;
    }
    EXPECT_GT(overlapping, 100);
}

TEST(ShadowOnTheGround, FarAndSmallOnesLoseTheRightArea) {
    // A pixel reaches over several of the ball's shadows: what counts is how much of all pixels is dark.
    Field field;
    SceneParameters p = plain_scene();
    p.ball_on_penalty_mark = false;
    p.ball_x = 2.0;
    p.ball_y = 1.5;
    Scene scene = make_scene(field, p);
    scene.tubes.clear();
    const LightParameters light = lamps(0.9, 0.9, 0.0);
    const Intrinsics camera;
    const RayTable rays(camera);
    for (const double distance : {1.0, 1.5, 2.0, 2.5, 3.0, 4.5, 7.0}) {
        const Eigen::Isometry3d T_WC = camera_at(2.0 - distance, 1.5, 0.003, 0.42, 0.02, 3 * degree);
        const LightImage lost = lost_light(scene, light, rays, T_WC);
        double sum = 0.0;
        for (const float share : lost.light) sum += static_cast<double>(share);
        // The ellipse as a polygon, projected.
        double area = 0.0;
        constexpr int corners = 720;
        const Eigen::Vector2d along(std::cos(light.azimuth), std::sin(light.azimuth));
        const double r = scene.ball.radius;
        const Eigen::Vector2d centre = Eigen::Vector2d(2.0, 1.5) - r / std::tan(light.elevation) * along;
        Eigen::Vector2d before;
        for (int i = 0; i <= corners; ++i) {
            const double a = 2.0 * std::numbers::pi * i / corners;
            const Eigen::Vector2d q = centre + r / std::sin(light.elevation) * std::cos(a) * along +
                                      r * std::sin(a) * Eigen::Vector2d(-along.y(), along.x());
            const Eigen::Vector2d now = *project(camera, T_WC.inverse() * Eigen::Vector3d(q.x(), q.y(), 0.0));
            if (i > 0) area += 0.5 * (before.x() * now.y() - now.x() * before.y());
            before = now;
        }
        EXPECT_NEAR(sum / std::abs(area), 1.0, distance < 1.5 ? 0.01 : 0.1) << distance;
    }
}

TEST(ShadowOnTheGround, PeopleCastNone) {
    SceneParameters p = plain_scene();
    p.spectators = 10;
    p.distractors = 6;
    Scene scene = make_scene(Field{}, p);
    std::erase_if(scene.tubes, [](const Tube& t) { return t.of != Tube::Of::hall; });
    ASSERT_FALSE(scene.tubes.empty());
    scene.ball.centre.x() = -50.0;
    const LightImage lost =
        lost_light(scene, lamps(0.3, 0.5, 0.0), RayTable(Intrinsics{}), camera_at(0, 0, 0.4, 0.42, 0.0, 0.0));
    EXPECT_EQ(std::count(lost.light.begin(), lost.light.end(), 0.0F),
              static_cast<std::ptrdiff_t>(lost.light.size()));
}

TEST(ShadowMap, FindsEveryShadowAPixelCanTouch) {
    SceneParameters p;
    p.robots = 6;
    const Scene scene = make_scene(Field{}, p);
    const Light light(lamps(0.9, 0.7, 0.1));
    const ShadowMap map(scene, light);
    std::vector<Shadow> all;
    for (const Tube& tube : scene.tubes)
        if (tube.of != Tube::Of::hall) all.emplace_back(tube.cylinder, light);
    all.emplace_back(scene.ball, light);
    Random random(5);
    int lost = 0;
    for (int i = 0; i < 20000; ++i) {
        const float size = static_cast<float>(std::exp(random.uniform(-6.0, -0.4)));
        const float turn = static_cast<float>(random.uniform(0.0, 3.0));
        const Footprint pixel{static_cast<float>(random.uniform(-4, 4)),
                              static_cast<float>(random.uniform(-3, 3)),
                              size * std::cos(turn),
                              size * std::sin(turn),
                              -0.3F * size * std::sin(turn),
                              0.3F * size * std::cos(turn)};
        float expected = 0.0F;
        for (const Shadow& shadow : all) expected = std::max(expected, shadow.share(pixel));
        const int first = map.first(pixel.x, pixel.y, 0.65F * size);
        EXPECT_NEAR(first < 0 ? 0.0F : map.share(first, pixel), expected, 1e-6F);
        if (expected > 0.0F) ++lost;
    }
    EXPECT_GT(lost, 500);
}

TEST(ShadowMap, IsEmptyWhereNoLampCastsAny) {
    const Scene scene = make_scene(Field{}, {});
    LightParameters p = lamps(0.5, 0.9, 0.0);
    EXPECT_FALSE(ShadowMap(scene, Light(p)).empty());
    p.elevation = 0.0;
    EXPECT_TRUE(ShadowMap(scene, Light(p)).empty());
    p.elevation = 0.9;
    p.directional = 0.0;
    EXPECT_TRUE(ShadowMap(scene, Light(p)).empty());
    p.directional = 0.3;
    p.shadows = false;
    EXPECT_TRUE(ShadowMap(scene, Light(p)).empty());
}

TEST(GroundPainter, AChangedSceneIsPaintedAsANewOne) {
    SceneParameters p;
    Light light(lamps(0.9, 1.0, 0.05));
    const Intrinsics camera;
    const RayTable rays(camera);
    const Eigen::Isometry3d T_WC = camera_at(-1, 0, 0.2, 0.42, 0.0, 0.2);
    const auto paint = [&](GroundPainter& painter) {
        painter.look(T_WC);
        return test::painted(rays,
                             [&](int, const RowRays& row, const LightRow& out) { painter.paint(row, out); })
            .light;
    };
    GroundPainter changed(make_scene(Field{}, p), light, camera);
    const auto before = paint(changed);
    p.robots = 5;
    p.carpet = {90, 60, 30};
    p.mottle = 0.1;
    const Scene scene = make_scene(Field{}, p);
    changed.change_scene(scene, light);
    GroundPainter fresh(scene, light, camera);
    const auto after = paint(changed);
    EXPECT_EQ(after, paint(fresh));
    EXPECT_NE(after, before);
}

}  // namespace
}  // namespace goalmouth
