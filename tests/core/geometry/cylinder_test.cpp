#include "core/geometry/cylinder.h"

#include "core/random/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Eigen::Isometry3d level_camera(double x, double y, double height) {
    Eigen::Isometry3d T_WC = camera_in_body(height, 0, 0);
    T_WC.translation().x() = x;
    T_WC.translation().y() = y;
    return T_WC;
}

TEST(Silhouette, HalfAngleGivesTheDistance) {
    const Cylinder post{{6.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.95, 0.05};
    const auto outline = silhouette(post, level_camera(0, 0, 0.42));
    ASSERT_TRUE(outline);
    EXPECT_NEAR(outline->axis_distance, 6.0, 1e-12);
    EXPECT_NEAR(outline->half_angle, std::asin(0.05 / 6.0), 1e-15);
    const double between = std::numbers::pi - std::acos(outline->left_plane.dot(outline->right_plane));
    EXPECT_NEAR(0.05 / std::sin(0.5 * between), 6.0, 1e-6);
}

TEST(Silhouette, WidthOfAPostInPixelsHasAClosedForm) {
    const Intrinsics camera;
    for (const double distance : {0.6, 1.5, 3.0, 3.5, 5.3, 6.0}) {
        const Cylinder post{{distance, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.95, 0.05};
        const auto edges = project_edges(camera, level_camera(0, 0, 0.42), post);
        ASSERT_TRUE(edges);
        const double expected = 2.0 * camera.fx * std::tan(std::asin(0.05 / distance));
        EXPECT_NEAR(edges->right_base.x() - edges->left_base.x(), expected, 1e-9);
        EXPECT_NEAR(edges->right_top.x() - edges->left_top.x(), expected, 1e-9);
        EXPECT_LT(edges->left_top.y(), edges->left_base.y());
    }
}

TEST(Silhouette, HoldsAllOfTheCylinderAndTouchesIt) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        Cylinder cylinder;
        cylinder.base = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 1)};
        cylinder.axis = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
        cylinder.length = random.uniform(0.2, 2.0);
        cylinder.radius = random.uniform(0.01, 0.3);
        Eigen::Isometry3d T_WC = camera_in_body(random.uniform(0.2, 1), random.uniform(-1, 1),
                                                random.uniform(-1, 1), random.uniform(-3, 3));
        const auto outline = silhouette(cylinder, T_WC);
        if (!outline) continue;
        const Eigen::Isometry3d T_CW = T_WC.inverse();
        const Eigen::Vector3d one = cylinder.axis.unitOrthogonal();
        const Eigen::Vector3d other = cylinder.axis.cross(one);
        double nearest_left = 1.0;
        double nearest_right = 1.0;
        for (int k = 0; k < 3600; ++k) {
            const double a = k * std::numbers::pi / 1800.0;
            const Eigen::Vector3d p =
                T_CW * (cylinder.base + random.uniform(0.0, cylinder.length) * cylinder.axis +
                        cylinder.radius * (std::cos(a) * one + std::sin(a) * other))
                           .eval();
            nearest_left = std::min(nearest_left, outline->left_plane.dot(p));
            nearest_right = std::min(nearest_right, outline->right_plane.dot(p));
        }
        EXPECT_GT(nearest_left, -1e-12);
        EXPECT_GT(nearest_right, -1e-12);
        EXPECT_LT(nearest_left, 1e-5);
        EXPECT_LT(nearest_right, 1e-5);
    }
}

TEST(Silhouette, LeftIsLeftInTheImage) {
    const Cylinder post{{2.0, 0.3, 0.0}, Eigen::Vector3d::UnitZ(), 0.95, 0.05};
    for (const double roll : {-0.35, 0.0, 0.35}) {
        const auto edges = project_edges(Intrinsics{}, camera_in_body(0.42, roll, 0.1, 0.2), post);
        ASSERT_TRUE(edges);
        EXPECT_LT(edges->left_base.x(), edges->right_base.x());
        EXPECT_LT(edges->left_top.x(), edges->right_top.x());
    }
}

TEST(Silhouette, CameraInsideHasNone) {
    const Cylinder post{{0.02, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.95, 0.05};
    EXPECT_FALSE(silhouette(post, level_camera(0, 0, 0.42)));
    EXPECT_FALSE(project_edges(Intrinsics{}, level_camera(0, 0, 0.42), post));
    // Inside the endless cylinder, above its top: there are no tangent planes either.
    EXPECT_FALSE(silhouette(post, level_camera(0, 0, 2.0)));
}

TEST(Silhouette, BehindTheCameraHasNoEdges) {
    const Cylinder post{{-2.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.95, 0.05};
    EXPECT_FALSE(project_edges(Intrinsics{}, level_camera(0, 0, 0.42), post));
}

TEST(Silhouette, EdgesAreCutWhereTheyPassBehindTheCamera) {
    // A camera that looks steeply down before a tall mast: the mast's top is behind the image plane.
    const Cylinder mast{{0.3, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 5.0, 0.05};
    const auto edges = project_edges(Intrinsics{}, camera_in_body(0.5, 0, 1.2), mast);
    ASSERT_TRUE(edges);
    EXPECT_TRUE(edges->left_top.allFinite());
    EXPECT_TRUE(edges->left_base.allFinite());
    EXPECT_LT(edges->left_top.y(), -1000.0);
}

}  // namespace
}  // namespace goalmouth
