#include "core/localisation/observation.h"

#include "tests/core/localisation/world.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::see_post;

constexpr double diameter = 0.1;

ObservationParameters exact() {
    ObservationParameters p;
    p.azimuth_floor = 0.001;
    p.distance_floor = 0.0;
    p.distance_fraction_floor = 0.0;
    p.line_sigma = 0.05;
    return p;
}

struct View {
    Post post;
    CameraPose camera;
    double azimuth;
    double distance;
    double roll;
};

/// Random views of a post in front of a rolled, pitched and panned camera, whole or in part.
std::vector<View> random_views(int count, double most_roll, Random& random) {
    std::vector<View> views;
    const Intrinsics intrinsics;
    while (static_cast<int>(views.size()) < count) {
        View v;
        v.roll = random.uniform(-most_roll, most_roll);
        const double pan = random.uniform(-1.5, 1.5);
        v.camera.T_BC = camera_in_body(random.uniform(0.35, 0.6), v.roll, random.uniform(-0.2, 0.5), pan);
        v.camera.T_BC.translation().x() = random.uniform(-0.05, 0.1);
        v.camera.T_BC.translation().y() = random.uniform(-0.05, 0.05);
        v.azimuth = wrap_angle(pan + random.uniform(-0.45, 0.45));
        v.distance = random.uniform(0.5, 7.0);
        const Eigen::Vector2d axis = v.camera.T_BC.translation().head<2>() +
                                     v.distance * Eigen::Vector2d(std::cos(v.azimuth), std::sin(v.azimuth));
        const double from = random.uniform(0.0, 0.4);
        const auto post =
            see_post(axis, diameter / 2, from, from + random.uniform(0.1, 0.5), v.camera.T_BC, intrinsics);
        if (!post) continue;
        v.post = *post;
        v.post.covariance << 0.01, 0, 0, 1e-6;
        views.push_back(v);
    }
    return views;
}

TEST(PostObservation, AzimuthAndDistanceAreExactUnderAnyRollPitchAndPan) {
    Random random(1);
    double worst_by_bearing = 0.0;
    for (const View& v : random_views(500, 0.5, random)) {
        const auto z = observe_post(v.post, Intrinsics{}, v.camera, diameter, exact());
        ASSERT_TRUE(z);
        // The middle between two edges is not quite the axis' picture at arm's length: tan(φ ± β), β = radius
        // / distance.
        EXPECT_NEAR(wrap_angle(z->azimuth - v.azimuth), 0.0, 0.001 + 0.0015 / (v.distance * v.distance));
        EXPECT_NEAR(1.0 / z->inverse_distance / v.distance, 1.0, 0.02);
        const Eigen::Vector3d forward = v.camera.T_BC.linear().col(2);
        const double pan = std::atan2(forward.y(), forward.x());
        worst_by_bearing =
            std::max(worst_by_bearing, std::abs(wrap_angle(pan + v.post.bearing_rad - v.azimuth)));
    }
    EXPECT_GT(worst_by_bearing, 0.1) << "the views would not tell an azimuth from a bearing";
}

TEST(PostObservation, PlaneCorrectsARollTheKinematicsDoNotKnow) {
    // The camera is rolled 3° more than the kinematics say, and they say so in their covariance. A tall post
    // that is seen well above and below the optical axis carries the roll in its own slope.
    const Intrinsics intrinsics;
    CameraPose said;
    said.T_BC = camera_in_body(0.45, 0.0, 0.0);
    said.covariance.diagonal().tail<3>().setConstant(0.05 * 0.05);
    const Eigen::Isometry3d real = camera_in_body(0.45, 0.052, 0.0);
    auto post =
        see_post({1.5, 0.3}, diameter / 2, 0.0, 0.45, real, intrinsics);  // below the axis: its middle moves
    ASSERT_TRUE(post);
    post->covariance << 0.01, 0, 0, 1e-6;
    const double azimuth = std::atan2(0.3, 1.5);
    const auto z = observe_post(*post, intrinsics, said, diameter, exact());
    ASSERT_TRUE(z);
    const Eigen::Vector2d middle = normalised_from_pixel(
        intrinsics, 0.25 * (post->left_top + post->left_base + post->right_top + post->right_base));
    const double by_middle = std::abs(-std::atan(middle.x()) - azimuth);
    EXPECT_GT(by_middle, 0.006);
    EXPECT_LT(std::abs(z->azimuth - azimuth), 0.003);
}

TEST(PostObservation, CovarianceIsThatOfRepeatedMeasurements) {
    // Pixels and camera angles are disturbed as stated; the scatter of what comes out must be what the
    // covariance says.
    Random random(2);
    const Intrinsics intrinsics;
    ObservationParameters p = exact();
    for (int scene = 0; scene < 5; ++scene) {
        const View v = random_views(1, 0.3, random).front();
        const double shift = 0.8;                     // px
        const double width = 0.02 * v.post.width_px;  // px
        const double angle = 0.02;                    // rad
        CameraPose camera = v.camera;
        camera.covariance.diagonal().tail<3>().setConstant(angle * angle);
        const Eigen::Vector2d middle = normalised_from_pixel(
            intrinsics, 0.25 * (v.post.left_top + v.post.left_base + v.post.right_top + v.post.right_base));
        const double bearing = shift / (intrinsics.fx * (1 + middle.x() * middle.x()));
        Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
        covariance(0, 0) = std::pow(v.post.distance_m * width / v.post.width_px, 2);
        covariance(1, 1) = bearing * bearing;

        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
        Eigen::Matrix2d stated = Eigen::Matrix2d::Zero();
        const int trials = 2000;
        for (int i = 0; i < trials; ++i) {
            Post post = v.post;
            post.covariance = covariance;
            const Eigen::Vector2d along = (post.left_base - post.left_top).normalized();
            const Eigen::Vector2d across{along.y(), -along.x()};
            const double e0 = shift * random.normal();
            const double e1 = std::sqrt(3.0) * shift * random.normal();
            for (Eigen::Vector2d* top : {&post.left_top, &post.right_top}) *top += (e0 + e1) * across;
            for (Eigen::Vector2d* base : {&post.left_base, &post.right_base}) *base += (e0 - e1) * across;
            post.width_px += width * random.normal();
            CameraPose said = camera;
            const Eigen::Vector3d turn =
                angle * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
            said.T_BC.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * camera.T_BC.linear();
            const auto z = observe_post(post, intrinsics, said, diameter, p);
            ASSERT_TRUE(z);
            const Eigen::Vector2d e(wrap_angle(z->azimuth - v.azimuth),
                                    z->inverse_distance - 1.0 / v.distance);
            sum += e;
            squares += e * e.transpose();
            stated += z->covariance;
        }
        const Eigen::Vector2d mean = sum / trials;
        const Eigen::Matrix2d scatter = squares / trials - mean * mean.transpose();
        stated /= trials;
        EXPECT_NEAR(std::sqrt(stated(0, 0) / scatter(0, 0)), 1.0, 0.2) << "azimuth, scene " << scene;
        EXPECT_NEAR(std::sqrt(stated(1, 1) / scatter(1, 1)), 1.0, 0.2) << "inverse distance, scene " << scene;
    }
}

TEST(PostObservation, KinematicUncertaintyAdds) {
    Random random(3);
    for (const View& v : random_views(50, 0.3, random)) {
        CameraPose unsure = v.camera;
        unsure.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 4e-4, 4e-4, 4e-4;
        const auto sure = observe_post(v.post, Intrinsics{}, v.camera, diameter, exact());
        const auto less = observe_post(v.post, Intrinsics{}, unsure, diameter, exact());
        ASSERT_TRUE(sure && less);
        EXPECT_GT(less->covariance(0, 0), sure->covariance(0, 0) + 0.9 * 4e-4) << "at least the yaw error";
        EXPECT_GE(less->covariance(1, 1), sure->covariance(1, 1));
    }
}

TEST(PostObservation, CovarianceIsPositiveDefiniteForRandomPosts) {
    Random random(4);
    int seen = 0;
    for (int i = 0; i < 3000; ++i) {
        Post post;
        const auto anywhere = [&] {
            return Eigen::Vector2d(random.uniform(-50, 690), random.uniform(-50, 530));
        };
        post.left_top = anywhere();
        post.left_base = anywhere();
        post.right_top = anywhere();
        post.right_base = i % 7 == 0 ? post.right_top : anywhere();
        post.width_px = random.uniform(0.0, 700.0);
        post.distance_m = random.uniform(0.0, 20.0);
        post.flags = static_cast<std::uint32_t>(random.index(256));
        const double s = random.uniform(0, 2);
        const double b = random.uniform(0, 0.3);
        post.covariance << s * s, random.uniform(-1, 1) * s * b, 0, b * b;
        post.covariance(1, 0) = post.covariance(0, 1);
        CameraPose camera;
        camera.T_BC =
            camera_in_body(0.4, random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3));
        const auto z = observe_post(post, Intrinsics{}, camera, diameter, ObservationParameters{});
        if (!z) continue;
        ++seen;
        ASSERT_TRUE(std::isfinite(z->azimuth));
        ASSERT_GT(z->covariance(0, 0), 0.0);
        if (z->has_distance) {
            ASSERT_GT(z->covariance.determinant(), 0.0);
            ASSERT_GT(z->inverse_distance, 0.0);
        }
    }
    EXPECT_GT(seen, 500);
}

TEST(PostObservation, DegeneratePostsAreLeftOutOrLoseTheirDistance) {
    Random random(5);
    View v = random_views(1, 0.1, random).front();
    Post fills = v.post;
    fills.flags = post_flag::fills_image;
    EXPECT_FALSE(observe_post(fills, Intrinsics{}, v.camera, diameter, exact()));
    Post one_edge = v.post;
    one_edge.flags = post_flag::no_distance | post_flag::left_edge_missing;
    one_edge.distance_m = 0.0;
    const auto z = observe_post(one_edge, Intrinsics{}, v.camera, diameter, exact());
    ASSERT_TRUE(z);
    EXPECT_FALSE(z->has_distance);
    EXPECT_NEAR(wrap_angle(z->azimuth - v.azimuth), 0.0, 0.003);
    Post point = v.post;
    point.left_top = point.left_base = point.right_top = point.right_base = {100, 100};
    EXPECT_TRUE(observe_post(point, Intrinsics{}, v.camera, diameter, exact()));
    Post nothing;
    EXPECT_FALSE(observe_post(nothing, Intrinsics{}, v.camera, diameter, exact()));
}

TEST(PostObservation, DetectorsDistanceIsTakenWhereAsked) {
    Random random(6);
    View v = random_views(1, 0.1, random).front();
    v.post.distance_m = 2.5;
    v.post.covariance(0, 0) = 0.04;
    ObservationParameters p = exact();
    p.distance = "message";
    const auto z = observe_post(v.post, Intrinsics{}, v.camera, diameter, p);
    ASSERT_TRUE(z);
    EXPECT_DOUBLE_EQ(z->inverse_distance, 0.4);
    EXPECT_NEAR(std::sqrt(z->covariance(1, 1)), 0.2 / (2.5 * 2.5), 1e-4);
}

/// As a refiner hands it on: exact to σ of 0.5 % and 0.5 mrad.
Post refined(Post post) {
    post.flags |= post_flag::refined;
    post.covariance << std::pow(0.005 * post.distance_m, 2), 0, 0, 2.5e-7;
    return post;
}

TEST(RefinedPostObservation, TakesItsOwnDistanceAndCovariance) {
    Random random(6);
    const ObservationParameters p;
    for (View v : random_views(100, 0.3, random)) {
        v.post = refined(v.post);
        v.post.distance_m *= 1.01;  // not what its width says
        v.post.covariance(0, 1) = v.post.covariance(1, 0) =
            0.5 * std::sqrt(v.post.covariance(0, 0) * v.post.covariance(1, 1));
        const auto z = observe_post(v.post, Intrinsics{}, v.camera, diameter, p);
        ASSERT_TRUE(z && z->has_distance);
        EXPECT_DOUBLE_EQ(z->inverse_distance, 1.0 / v.post.distance_m);
        const double sigma = std::sqrt(z->covariance(1, 1)) * v.post.distance_m * v.post.distance_m;
        const double floor =
            std::hypot(p.refined_distance_floor, p.refined_distance_fraction_floor * v.post.distance_m);
        EXPECT_NEAR(sigma, std::hypot(0.005 * v.post.distance_m / 1.01, floor), 1e-3 * sigma);
        EXPECT_LT(z->covariance(0, 1), 0.0) << "farther and more to the left go together";
        EXPECT_LT(std::sqrt(z->covariance(0, 0)), 0.02);
        EXPECT_EQ(z->common_azimuth_variance, 0.0) << "a camera whose yaw is known";
    }
}

TEST(RefinedPostObservation, OthersAreAsEver) {
    Random random(6);
    ObservationParameters other;
    other.refined_azimuth_floor = 0.1;
    other.refined_distance_floor = other.refined_distance_fraction_floor = 0.5;
    other.refined_line_sigma = 10.0;
    for (View v : random_views(100, 0.3, random)) {
        v.camera.covariance.diagonal().tail<3>().setConstant(4e-4);
        const auto a = observe_post(v.post, Intrinsics{}, v.camera, diameter, ObservationParameters{});
        const auto b = observe_post(v.post, Intrinsics{}, v.camera, diameter, other);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->covariance, b->covariance);
        EXPECT_EQ(a->azimuth, b->azimuth);
        EXPECT_EQ(a->inverse_distance, b->inverse_distance);
        EXPECT_EQ(a->common_azimuth_variance, 0.0);
    }
}

TEST(RefinedPostObservation, OneEdgeAloneGivesADirection) {
    Random random(6);
    for (View v : random_views(50, 0.3, random)) {
        v.post = refined(v.post);
        v.post.flags |= post_flag::no_distance | post_flag::left_edge_missing;
        v.post.distance_m = 0.0;
        const auto z = observe_post(v.post, Intrinsics{}, v.camera, diameter, ObservationParameters{});
        ASSERT_TRUE(z);
        EXPECT_FALSE(z->has_distance);
        EXPECT_LT(std::sqrt(z->covariance(0, 0)), 0.02);
    }
}

// Two posts of one frame, the camera's attitude wrong by 2° about each axis: azimuths are wrong by as much,
// all the same way, and the angle between them is not.
TEST(RefinedPostObservation, AzimuthErrorsOfAFrameAreCommonButForWhatCovarianceSays) {
    Random random(8);
    const Intrinsics intrinsics;
    constexpr double attitude_sigma = 0.035;
    constexpr double pixel_sigma = 0.03;
    double square_alone = 0.0;
    double square_between = 0.0;
    double raw_between = 0.0;
    constexpr int trials = 600;
    for (int trial = 0; trial < trials; ++trial) {
        CameraPose truth;
        truth.T_BC = camera_in_body(0.42, random.uniform(-0.1, 0.1), random.uniform(0.0, 0.3));
        std::vector<PostObservation> z;
        CameraPose measured = truth;
        const Eigen::Vector3d turn(attitude_sigma * random.normal(), attitude_sigma * random.normal(),
                                   attitude_sigma * random.normal());
        measured.T_BC.linear() =
            Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * truth.T_BC.linear();
        measured.covariance.diagonal().tail<3>().setConstant(attitude_sigma * attitude_sigma);
        const std::vector<Eigen::Vector2d> axes = {{3.0, 0.8}, {2.6, -0.7}};
        for (const Eigen::Vector2d& axis : axes) {
            Post post = *see_post(axis, diameter / 2, 0.0, 0.8, truth.T_BC, intrinsics);
            // A line's error: in its middle, and as a turn about it.
            const double shift = pixel_sigma * random.normal();
            const double tilt = std::sqrt(3.0) * pixel_sigma * random.normal();
            for (Eigen::Vector2d* corner : {&post.left_top, &post.right_top}) corner->x() += shift + tilt;
            for (Eigen::Vector2d* corner : {&post.left_base, &post.right_base}) corner->x() += shift - tilt;
            post.flags |= post_flag::refined;
            post.distance_m = (axis - truth.T_BC.translation().head<2>()).norm();
            post.covariance << 1e-4, 0, 0, std::pow(pixel_sigma / intrinsics.fx, 2);
            ObservationParameters p;
            p.refined_azimuth_floor = 0.0001;
            p.refined_line_sigma = 0.001;
            z.push_back(*observe_post(post, intrinsics, measured, diameter, p));
        }
        const auto error = [&](std::size_t i) {
            return wrap_angle(z[i].azimuth - std::atan2(axes[i].y(), axes[i].x()));
        };
        EXPECT_GT(z[0].common_azimuth_variance, 0.9 * attitude_sigma * attitude_sigma);
        const auto own = [&](std::size_t i) { return z[i].covariance(0, 0) - z[i].common_azimuth_variance; };
        square_alone += std::pow(error(0), 2) / z[0].covariance(0, 0) / trials;
        square_between += std::pow(error(0) - error(1), 2) / (own(0) + own(1)) / trials;
        raw_between += std::pow(error(0) - error(1), 2) / trials;
    }
    EXPECT_NEAR(square_alone, 1.0, 0.2);
    // Two degrees of roll and pitch also act to second order, which the covariance bounds.
    EXPECT_GT(square_between, 0.1);
    EXPECT_LT(square_between, 1.3);
    EXPECT_LT(std::sqrt(raw_between), 0.1 * attitude_sigma);
}

TEST(PostObservation, WidestPostsComeFirstWhateverTheirOrder) {
    Random random(7);
    std::vector<Post> posts;
    CameraPose camera;
    camera.T_BC = camera_in_body(0.45, 0, 0);
    for (const double d : {4.0, 1.0, 3.0, 2.0, 5.0, 6.0}) {
        posts.push_back(*see_post({d, 0.2}, diameter / 2, 0.1, 0.8, camera.T_BC, Intrinsics{}));
        posts.back().covariance << 0.01, 0, 0, 1e-4;
    }
    const auto frame = observe_posts(posts, Intrinsics{}, camera, diameter, ObservationParameters{});
    ASSERT_EQ(frame.posts.size(), 4U);
    EXPECT_EQ(frame.unusable, 2);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(1.0 / frame.posts[i].inverse_distance, static_cast<double>(i + 1), 0.2);
    std::swap(posts[0], posts[5]);
    std::swap(posts[1], posts[3]);
    const auto again = observe_posts(posts, Intrinsics{}, camera, diameter, ObservationParameters{});
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(again.posts[i].azimuth, frame.posts[i].azimuth);
}

}  // namespace
}  // namespace goalmouth
