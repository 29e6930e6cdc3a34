#include "core/refinement/post_silhouette.h"

#include "core/geometry/cylinder.h"
#include "core/refinement/pixel_rays.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

PostSilhouette example() {
    PostSilhouette post;
    post.half_angle = 0.05;
    return post.moved({0.2, 0.1, -0.15, 0.0});
}

TEST(PostSilhouette, AgreesWithTheCylinderItTouches) {
    Cylinder cylinder;
    cylinder.base = {2.0, 0.7, 0.0};
    const Eigen::Isometry3d T_WC = camera_in_body(0.5, 0.2, 0.1);
    const auto truth = silhouette(cylinder, T_WC);
    ASSERT_TRUE(truth);
    const Eigen::Vector3d up = T_WC.linear().transpose().col(2);
    const PostSilhouette post = silhouette_between(truth->left_plane, truth->right_plane, up);
    EXPECT_NEAR(post.half_angle, truth->half_angle, 1e-12);
    EXPECT_LT((post.plane(OutlineSide::left) - truth->left_plane).norm(), 1e-12);
    EXPECT_LT((post.plane(OutlineSide::right) - truth->right_plane).norm(), 1e-12);
    EXPECT_NEAR(cylinder.radius / std::sin(post.half_angle), std::hypot(2.0, 0.7), 1e-9);
}

TEST(PostSilhouette, MovesAsItsDerivativeSays) {
    const PostSilhouette post = example();
    for (const OutlineSide side : {OutlineSide::left, OutlineSide::right}) {
        for (int k = 0; k < 4; ++k) {
            constexpr double h = 1e-6;
            SilhouetteStep step = SilhouetteStep::Zero();
            step[k] = h;
            const Eigen::Vector3d change =
                (post.moved(step).plane(side) - post.moved(-step).plane(side)) / (2.0 * h);
            EXPECT_LT((change - post.plane_change(side).col(k)).norm(), 1e-8) << k;
        }
    }
}

TEST(PostSilhouette, StaysOrthonormal) {
    const PostSilhouette post = example().moved({0.1, -0.2, 0.1, 0.01});
    EXPECT_NEAR(post.right.dot(post.up), 0.0, 1e-12);
    EXPECT_NEAR(post.up.norm(), 1.0, 1e-12);
    EXPECT_LT((post.up.cross(post.right) - post.ahead).norm(), 1e-12);
}

TEST(PixelRays, FollowTheLensAsTheCameraDoes) {
    Intrinsics camera;
    camera.distortion = {-0.25, 0.05, 0.002, -0.001, 0.0};
    PixelRays rays(camera);
    for (double y = 0.0; y < 480.0; y += 7.0) {
        for (const double x : {20.0, 320.0, 610.0}) {
            const RowRay ray = rays.at(x, y);
            const Eigen::Vector2d exact = normalised_from_pixel(camera, {x, y});
            EXPECT_LT((ray.ray.head<2>() - exact).norm(), 1e-8);
            const Eigen::Vector2d next = normalised_from_pixel(camera, {x + 0.01, y});
            EXPECT_LT((ray.slope.head<2>() - (next - exact) / 0.01).norm(), 1e-6);
        }
    }
    const Eigen::Vector3d plane = Eigen::Vector3d(1.0, 0.1, -0.3).normalized();
    const RowRay at = rays.crossing(plane, 400.0, 100.0);
    const Eigen::Vector2d hit = normalised_from_pixel(camera, {at.x, 100.0});
    EXPECT_NEAR(plane.dot(hit.homogeneous()), 0.0, 1e-7);
}

}  // namespace
}  // namespace goalmouth
