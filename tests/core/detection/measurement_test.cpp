#include "core/detection/measurement.h"

#include "core/random/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Post post_between(double left, double right, double top = 100, double base = 300) {
    Post post;
    post.left_top = {left, top};
    post.left_base = {left, base};
    post.right_top = {right, top};
    post.right_base = {right, base};
    return post;
}

TEST(Measurement, DistanceIsThePapersFormula) {
    const Intrinsics camera = from_horizontal_fov(640, 480, 60.0 * std::numbers::pi / 180.0);
    Post post = post_between(309.5, 329.5);
    measure_post(post, camera, 0.1, 0.1, 0.1, {});
    const double gamma = 640.0 / (2.0 * std::tan(30.0 * std::numbers::pi / 180.0));
    EXPECT_NEAR(post.distance_m, 0.1 / 20.0 * gamma, 1e-9);
    EXPECT_NEAR(post.bearing_rad, 0.0, 1e-9);
    EXPECT_EQ(post.flags, 0U);
}

TEST(Measurement, DistanceDoesNotDependOnTheLean) {
    for (const double lean : {-0.3, 0.0, 0.35}) {
        const Eigen::Rotation2Dd turn(lean);
        const Eigen::Vector2d c(320, 240);
        Post post = post_between(309.5, 329.5);
        for (Eigen::Vector2d* p : {&post.left_top, &post.left_base, &post.right_top, &post.right_base})
            *p = c + turn * (*p - c);
        measure_post(post, {}, 0.1, 0.1, 0.1, {});
        EXPECT_NEAR(post.width_px, 20.0, 1e-9);
        EXPECT_NEAR(post.distance_m, 0.1 * 554.26 / 20.0, 1e-9);
    }
}

TEST(Measurement, BearingIsPositiveToTheLeftAndUndistorted) {
    Intrinsics camera;
    Post left = post_between(90, 110);
    measure_post(left, camera, 0.1, 0, 0, {});
    EXPECT_NEAR(left.bearing_rad, std::atan((319.5 - 100) / 554.26), 1e-12);
    camera.distortion[0] = -0.1;
    Post bent = post_between(90, 110);
    measure_post(bent, camera, 0.1, 0, 0, {});
    const Eigen::Vector2d middle(100, 200);
    EXPECT_NEAR(bent.bearing_rad, -std::atan(normalised_from_pixel(camera, middle).x()), 1e-12);
    EXPECT_GT(bent.bearing_rad, left.bearing_rad + 1e-3);
}

TEST(Measurement, CovarianceIsThatOfJitteredEdges) {
    MeasurementParameters parameters;
    parameters.edge_noise = 0.0;
    parameters.distance_floor = 0.0;
    parameters.bearing_floor = 0.0;
    const double sigma_left = 0.2;
    const double sigma_right = 0.5;
    Post nominal = post_between(200, 225);
    measure_post(nominal, {}, 0.1, sigma_left, sigma_right, parameters);

    Random random(11);
    Eigen::Matrix2d sampled = Eigen::Matrix2d::Zero();
    constexpr int samples = 20000;
    for (int i = 0; i < samples; ++i) {
        Post post = post_between(200 + sigma_left * random.normal(), 225 + sigma_right * random.normal());
        measure_post(post, {}, 0.1, 0, 0, parameters);
        const Eigen::Vector2d error(post.distance_m - nominal.distance_m,
                                    post.bearing_rad - nominal.bearing_rad);
        sampled += error * error.transpose() / samples;
    }
    EXPECT_NEAR(sampled(0, 0) / nominal.covariance(0, 0), 1.0, 0.05);
    EXPECT_NEAR(sampled(1, 1) / nominal.covariance(1, 1), 1.0, 0.05);
    EXPECT_NEAR(sampled(0, 1) / nominal.covariance(0, 1), 1.0, 0.1);
    EXPECT_EQ(nominal.covariance(0, 1), nominal.covariance(1, 0));
}

TEST(Measurement, UncertaintyGrowsWithTheSquareOfTheDistance) {
    MeasurementParameters parameters;
    parameters.distance_floor = 0.0;
    Post near = post_between(300, 340);
    Post far = post_between(315, 325);
    measure_post(near, {}, 0.1, 0.1, 0.1, parameters);
    measure_post(far, {}, 0.1, 0.1, 0.1, parameters);
    EXPECT_NEAR(std::sqrt(far.covariance(0, 0) / near.covariance(0, 0)), 16.0, 1e-6);
}

TEST(Measurement, FlagsWhatTheImageCuts) {
    Post post = post_between(300, 320, 2, 478);
    measure_post(post, {}, 0.1, 0, 0, {});
    EXPECT_EQ(post.flags, post_flag::cut_top | post_flag::cut_bottom);
    EXPECT_GT(post.distance_m, 0.0);
    Post cut = post_between(-0.5, 20);
    cut.flags = post_flag::left_edge_missing;
    measure_post(cut, {}, 0.1, 0, 0, {});
    EXPECT_TRUE(cut.has(post_flag::no_distance));
    EXPECT_TRUE(cut.has(post_flag::cut_left));
    EXPECT_EQ(cut.distance_m, 0.0);
    EXPECT_GE(cut.covariance(0, 0), 100.0);
}

TEST(Measurement, OfADegeneratePostIsFinite) {
    Post post;
    measure_post(post, {}, 0.1, 0, 0, {});
    EXPECT_GT(post.width_px, 0.0);
    EXPECT_TRUE(std::isfinite(post.distance_m));
    EXPECT_TRUE(post.covariance.allFinite());
}

TEST(Measurement, AngularWidthFollowsTheAxis) {
    Intrinsics camera;
    camera.fx = 500;
    camera.fy = 400;
    EXPECT_NEAR(pixel_angular_width(camera, {0, 1}), 500, 1e-9);
    EXPECT_NEAR(pixel_angular_width(camera, {-3, 0}), 400, 1e-9);
}

}  // namespace
}  // namespace goalmouth
