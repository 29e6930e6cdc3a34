#include "core/geometry/camera.h"

#include "core/random/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

Intrinsics with_distortion() {
    Intrinsics camera;
    camera.distortion = {-0.09, 0.03, 0.001, -0.0007, 0.002};
    return camera;
}

TEST(Camera, FocalLengthOfTheC905) {
    const Intrinsics camera = from_horizontal_fov(640, 480, 60.0 * degree);
    EXPECT_NEAR(camera.fx, 554.256, 1e-3);
    EXPECT_DOUBLE_EQ(camera.cx, 319.5);
    EXPECT_DOUBLE_EQ(camera.cy, 239.5);
    // The rim of the image (half a pixel beyond the last centre) lies at half the field of view.
    EXPECT_NEAR(std::atan(normalised_from_pixel(camera, {639.5, 239.5}).x()), 30.0 * degree, 1e-12);
}

TEST(Camera, ProjectsByThePinholeEquation) {
    const Intrinsics camera;
    const auto p = project(camera, {0.3, -0.2, 2.0});
    ASSERT_TRUE(p);
    EXPECT_NEAR(p->x(), 319.5 + 554.26 * 0.15, 1e-9);
    EXPECT_NEAR(p->y(), 239.5 - 554.26 * 0.1, 1e-9);
}

TEST(Camera, NothingBehindTheCameraIsSeen) {
    EXPECT_FALSE(project(Intrinsics{}, {0.0, 0.0, 0.0}));
    EXPECT_FALSE(project(Intrinsics{}, {0.1, 0.2, -1.0}));
    EXPECT_FALSE(project(Intrinsics{}, {0.1, 0.2, std::nan("")}));
}

TEST(Camera, UndistortsWhatItDistorts) {
    for (const Intrinsics& camera : {Intrinsics{}, with_distortion()})
        for (double x = 0.0; x < 640.0; x += 37.3)
            for (double y = 0.0; y < 480.0; y += 29.1) {
                const Eigen::Vector2d n = normalised_from_pixel(camera, {x, y});
                ASSERT_LT((pixel_from_normalised(camera, n) - Eigen::Vector2d(x, y)).norm(), 1e-8);
            }
}

TEST(Camera, KnowsHowPixelsMoveWithTheirRays) {
    for (const Intrinsics& camera : {Intrinsics{}, with_distortion()}) {
        for (const Eigen::Vector2d& n : {Eigen::Vector2d(0.0, 0.0), {0.5, -0.3}, {-0.2, 0.4}}) {
            const Eigen::Matrix2d change = pixel_change(camera, n);
            constexpr double step = 1e-5;
            for (int i = 0; i < 2; ++i) {
                const Eigen::Vector2d off = step * Eigen::Vector2d::Unit(i);
                const Eigen::Vector2d moved =
                    pixel_from_normalised(camera, n + off) - pixel_from_normalised(camera, n - off);
                EXPECT_LT((change.col(i) - moved / (2.0 * step)).norm(), 1e-5);
            }
        }
    }
}

TEST(Camera, BarrelDistortionPullsTheCornersIn) {
    Intrinsics camera;
    camera.distortion = {-0.1, 0, 0, 0, 0};
    const Eigen::Vector2d corner(0.5, 0.4);
    const Eigen::Vector2d ideal = pixel_from_normalised(Intrinsics{}, corner);
    const Eigen::Vector2d bent = pixel_from_normalised(camera, corner);
    const Eigen::Vector2d centre(camera.cx, camera.cy);
    EXPECT_NEAR((bent - centre).norm() / (ideal - centre).norm(), 1.0 - 0.1 * corner.squaredNorm(), 1e-12);
}

TEST(Camera, ScalingKeepsRays) {
    const Intrinsics camera = with_distortion();
    const Intrinsics large = scaled_to(camera, 1600, 1200);
    EXPECT_EQ(large.width, 1600);
    EXPECT_EQ(large.height, 1200);
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(100.25, 300), Eigen::Vector2d(639, 479)}) {
        const Eigen::Vector2d scaled((p.x() + 0.5) * 2.5 - 0.5, (p.y() + 0.5) * 2.5 - 0.5);
        EXPECT_LT((normalised_from_pixel(camera, p) - normalised_from_pixel(large, scaled)).norm(), 1e-10);
    }
    EXPECT_EQ(scaled_to(camera, camera.width, camera.height), camera);
}

TEST(CameraInBody, LooksWhereItIsTurned) {
    const Eigen::Vector3d ahead = camera_in_body(0.4, 0, 0).linear() * Eigen::Vector3d::UnitZ();
    EXPECT_LT((ahead - Eigen::Vector3d::UnitX()).norm(), 1e-12);
    const Eigen::Vector3d left = camera_in_body(0.4, 0, 0, 90 * degree).linear() * Eigen::Vector3d::UnitZ();
    EXPECT_LT((left - Eigen::Vector3d::UnitY()).norm(), 1e-12);
    const Eigen::Vector3d down = camera_in_body(0.4, 0, 30 * degree).linear() * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR(down.z(), -0.5, 1e-12);
    EXPECT_NEAR(camera_in_body(0.4, 0, 0).translation().z(), 0.4, 1e-12);
}

TEST(CameraInBody, RollTurnsTheImageTheOtherWay) {
    // Clockwise roll: the camera's right side sinks, so what is straight up in the world leans to the left in
    // the image.
    const Eigen::Isometry3d T_BC = camera_in_body(0.4, 10 * degree, 0);
    const Eigen::Vector3d right = T_BC.linear() * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(right.z(), -std::sin(10 * degree), 1e-12);
    const Eigen::Vector3d up = T_BC.linear().transpose() * Eigen::Vector3d::UnitZ();
    EXPECT_LT(up.x(), 0.0);
    EXPECT_LT(up.y(), 0.0);
}

TEST(GroundPoint, AgreesWithTrigonometry) {
    const Intrinsics camera;
    const double h = 0.42;
    const auto p = ground_point(camera, camera_in_body(h, 0, 15 * degree), {camera.cx, camera.cy});
    ASSERT_TRUE(p);
    EXPECT_NEAR(p->x(), h / std::tan(15 * degree), 1e-9);
    EXPECT_NEAR(p->y(), 0.0, 1e-9);
}

TEST(GroundPoint, NothingAtOrAboveTheHorizon) {
    const Intrinsics camera;
    const double pitch = 10 * degree;
    const double horizon = camera.cy - camera.fy * std::tan(pitch);
    const Eigen::Isometry3d T_WC = camera_in_body(0.42, 0, pitch);
    EXPECT_FALSE(ground_point(camera, T_WC, {100.0, horizon}));
    EXPECT_FALSE(ground_point(camera, T_WC, {100.0, horizon - 5.0}));
    EXPECT_TRUE(ground_point(camera, T_WC, {100.0, horizon + 0.5}));
}

TEST(GroundPoint, UndoesProjection) {
    Random random(1);
    const Intrinsics camera = with_distortion();
    for (int i = 0; i < 300; ++i) {
        Eigen::Isometry3d T_WC = camera_in_body(random.uniform(0.2, 1.0), random.uniform(-0.3, 0.3),
                                                random.uniform(0.1, 0.6), random.uniform(-3, 3));
        T_WC.translation().head<2>() = Eigen::Vector2d(random.uniform(-3, 3), random.uniform(-2, 2));
        const Eigen::Vector2d pixel(random.uniform(0, 639), random.uniform(240, 479));
        const auto ground = ground_point(camera, T_WC, pixel);
        if (!ground) continue;
        const auto back = project(camera, T_WC.inverse() * Eigen::Vector3d(ground->x(), ground->y(), 0.0));
        ASSERT_TRUE(back);
        EXPECT_LT((*back - pixel).norm(), 1e-5);
    }
}

TEST(FoldsBack, WhereTheRadiusNoLongerGrows) {
    EXPECT_FALSE(folds_back(Intrinsics{}, {50.0, 0.0})) << "no distortion";
    Intrinsics barrel;
    barrel.distortion = {-0.2, 0, 0, 0, 0};
    const double fold = std::sqrt(1.0 / 0.6);  // 1 + 3·k1·r² = 0
    for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
        const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
        EXPECT_FALSE(folds_back(barrel, 0.999 * fold * out));
        EXPECT_TRUE(folds_back(barrel, 1.001 * fold * out));
        // Beyond r = √5 the radius grows again, on the other side.
        EXPECT_TRUE(folds_back(barrel, 2.5 * out));
        EXPECT_TRUE(folds_back(barrel, 20.0 * out));
    }
}

TEST(FoldsBack, AlsoBeyondAFoldThatUnfolds) {
    // 1 − 1.2·s + 0.3·s²: negative between s = 1.18 and 2.82 alone.
    Intrinsics camera;
    camera.distortion = {-0.4, 0.06, 0, 0, 0};
    EXPECT_FALSE(folds_back(camera, {std::sqrt(1.17), 0.0}));
    EXPECT_TRUE(folds_back(camera, {std::sqrt(1.19), 0.0}));
    EXPECT_TRUE(folds_back(camera, {std::sqrt(4.0), 0.0}));
    // With k3 as well: 1 − 3.6·s + 3.5·s² − 0.7·s³, negative about s = 0.65 and far out.
    camera.distortion = {-1.2, 0.7, 0, 0, -0.1};
    EXPECT_FALSE(folds_back(camera, {std::sqrt(0.4), 0.0}));
    EXPECT_TRUE(folds_back(camera, {std::sqrt(0.65), 0.0}));
    EXPECT_TRUE(folds_back(camera, {std::sqrt(1.0), 0.0}));
    // A dip that stays above 0 folds nothing: 1 − 0.9·s + 0.3·s².
    camera.distortion = {-0.3, 0.06, 0, 0, 0};
    EXPECT_FALSE(folds_back(camera, {std::sqrt(1.5), 0.0}));
    EXPECT_FALSE(folds_back(camera, {3.0, 1.0}));
}

TEST(FoldsBack, AgreesWithTheDistortedRadiusOnTheWayOut) {
    const Intrinsics camera = with_distortion();
    const Eigen::Vector2d principal(camera.cx, camera.cy);
    for (const double angle : {0.3, 1.9, 3.3, 5.0}) {
        const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
        double last = 0.0;
        for (double r = 0.01; r < 4.0; r += 0.01) {
            const double radius = (pixel_from_normalised(camera, r * out) - principal).norm();
            if (radius < last) break;
            last = radius;
            ASSERT_FALSE(folds_back(camera, (r - 0.01) * out)) << r;
        }
    }
}

}  // namespace
}  // namespace goalmouth
