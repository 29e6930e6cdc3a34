#include "core/simulation/walker.h"

#include "core/simulation/odometry_model.h"
#include "core/simulation/truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Field large_field() {
    Field field;
    field.length = 9.0;
    field.width = 6.0;
    field.penalty_mark_distance = 2.1;
    field.circle_diameter = 1.5;
    return field;
}

TEST(Route, StartsAsThePaperDoes) {
    const Field field;
    const Route route = paper_route(field);
    const Pose2 start = route.at(0.0);
    EXPECT_NEAR(start.x, -1.8, 1e-9);  // half-way between goal line (3 m) and circle (0.6 m)
    EXPECT_NEAR(start.y, -2.0, 1e-9);  // on the side line
    EXPECT_GT(std::sin(start.theta), 0.9);
    double nearest = 10.0;
    for (double s = 0.0; s < route.lead_in_length(); s += 0.01)
        nearest = std::min(nearest, (route.at(s).position() - Eigen::Vector2d(-1.2, 0.0)).norm());
    EXPECT_LT(nearest, 0.35);
    EXPECT_GT(nearest, 0.15);  // it does not tread on the ball
}

TEST(Route, StaysOnTheFieldAndIsSmooth) {
    for (const Field& field : {Field{}, large_field()}) {
        const Route route = paper_route(field);
        constexpr double step = 0.01;
        Pose2 last = route.at(0.0);
        double last_turn = 0.0;
        for (double s = step; s < 60.0; s += step) {
            const Pose2 here = route.at(s);
            ASSERT_LE(std::abs(here.x), field.length / 2.0 - 0.4);
            ASSERT_LE(std::abs(here.y), field.width / 2.0 + 1e-9);
            ASSERT_NEAR((here.position() - last.position()).norm(), step, 1e-3) << s;
            const double turn = wrap_angle(here.theta - last.theta) / step;
            ASSERT_LT(std::abs(turn), 4.0) << s;  // rad/m: turns no tighter than 25 cm
            if (s > 2 * step) {
                ASSERT_LT(std::abs(turn - last_turn), 0.5) << s;
            }
            last_turn = turn;
            last = here;
        }
    }
}

TEST(Route, GoesRoundForEver) {
    const Route route = paper_route(Field{});
    const double s = route.lead_in_length() + 1.234;
    const Pose2 once = route.at(s);
    const Pose2 again = route.at(s + 50.0 * route.loop_length());
    EXPECT_NEAR(once.x, again.x, 1e-6);
    EXPECT_NEAR(once.y, again.y, 1e-6);
}

TEST(Route, RefusesWhatIsNoRoute) {
    const Eigen::Vector2d p(0, 0), q(1, 0), r(1, 1);
    EXPECT_THROW(Route(p, p, {}, {p, q, r}), std::invalid_argument);
    EXPECT_THROW(Route(p, q, {}, {q, r}), std::invalid_argument);
}

Walker make_walker(const WalkParameters& parameters = {}, std::uint64_t seed = 1) {
    return Walker(parameters, Field{}, paper_route(Field{}), Random(seed));
}

TEST(Walker, MovesLikeARobot) {
    Walker walker = make_walker();
    constexpr double dt = 1.0 / 30.0;
    Pose2 last = walker.pose();
    Eigen::Isometry3d last_head = walker.T_BC();
    double largest_roll = 0.0, lowest = 1.0, highest = 0.0;
    for (int k = 1; k < 30 * 180; ++k) {
        walker.advance(k * dt);
        const Pose2 pose = walker.pose();
        const Pose2 moved = difference(last, pose);
        ASSERT_LT(std::hypot(moved.x, moved.y), 0.21 * dt);
        ASSERT_LT(std::abs(moved.theta), 0.8 * dt);
        ASSERT_LT(std::abs(moved.y), 0.003);
        const Eigen::Isometry3d head = walker.T_BC();
        ASSERT_LT(Eigen::AngleAxisd(last_head.linear().transpose() * head.linear()).angle(), 3.5 * dt);
        // Lean: how far the camera's x axis is from level, for it is level in an upright robot.
        largest_roll = std::max(largest_roll, std::abs(std::asin(head.linear().col(0).z())));
        lowest = std::min(lowest, head.translation().z());
        highest = std::max(highest, head.translation().z());
        last = pose;
        last_head = head;
    }
    EXPECT_GT(largest_roll, 0.035);
    EXPECT_LT(largest_roll, 0.09);
    EXPECT_GT(lowest, 0.40);
    EXPECT_LT(highest, 0.45);
}

TEST(Walker, IsAFunctionOfTimeHoweverOftenItIsAsked) {
    Walker often = make_walker();
    Walker seldom = make_walker();
    for (int k = 1; k <= 400; ++k) {
        for (int i = 1; i <= 10; ++i) often.advance((10 * (k - 1) + i) / 40.0);
        seldom.advance(10 * k / 40.0);
        ASSERT_EQ(often.T_BC().matrix(), seldom.T_BC().matrix());
        ASSERT_EQ(often.T_WC().matrix(), seldom.T_WC().matrix());
        ASSERT_EQ(often.odometry().x, seldom.odometry().x);
        ASSERT_EQ(often.odometry().theta, seldom.odometry().theta);
    }
}

TEST(Walker, MotionIsTheDerivativeOfTheCamerasPose) {
    Walker walker = make_walker();
    constexpr double dt = 0.0005;
    double fastest = 0.0, fastest_turn = 0.0;
    for (double t = 0.0125; t < 60.0; t += 0.23) {
        // All three within one tick of the head's joints.
        walker.advance(0.01 * std::floor(t / 0.01) + 0.005 - dt);
        const Eigen::Isometry3d before = walker.T_WC();
        walker.advance(walker.time() + dt);
        const CameraMotion motion = walker.motion();
        EXPECT_EQ(motion.T_WC.matrix(), walker.T_WC().matrix());
        walker.advance(walker.time() + dt);
        const Eigen::Isometry3d after = walker.T_WC();
        const Eigen::Vector3d velocity = (after.translation() - before.translation()) / (2.0 * dt);
        const Eigen::AngleAxisd turned(Eigen::Matrix3d(before.linear().transpose() * after.linear()));
        const Eigen::Vector3d turn_rate = turned.angle() / (2.0 * dt) * turned.axis();
        // Where pieces of the route meet, its curvature jumps: there the two differences need not agree
        // better.
        ASSERT_LT((motion.velocity - velocity).norm(), 1e-3) << t;
        ASSERT_LT((motion.turn_rate - turn_rate).norm(), 5e-3) << t;
        // Over a frame's readout the even motion stays close to the true one.
        ASSERT_LT((motion.at(dt).translation() - after.translation()).norm(), 1e-6) << t;
        fastest = std::max(fastest, velocity.norm());
        fastest_turn = std::max(fastest_turn, turn_rate.norm());
    }
    EXPECT_GT(fastest, 0.3);
    EXPECT_GT(fastest_turn, 0.6);
}

TEST(Walker, MotionOfARestingCameraIsNone) {
    WalkParameters parameters;
    parameters.gait.speed = 0.0;
    parameters.head.sweep = 0.0;
    parameters.head.search_sweep = 0.0;
    parameters.head.tilt_sweep = 0.0;
    Walker walker = make_walker(parameters);
    walker.advance(5.0);
    EXPECT_TRUE(walker.motion().still());
}

TEST(Walker, SeesGoalpostsMuchOfTheTime) {
    for (const Field& field : {Field{}, large_field()}) {
        const Scene scene = make_scene(field, {});
        Walker walker({}, field, paper_route(field), Random(1));
        int with_post = 0;
        int frames = 0;
        for (double t = 0.0; t < 180.0; t += 0.1, ++frames) {
            walker.advance(t);
            const auto posts = true_posts(scene, Intrinsics{}, walker.T_WC());
            if (std::any_of(posts.begin(), posts.end(), [](const TruePost& p) { return p.visible > 0.3; }))
                ++with_post;
        }
        EXPECT_GT(with_post, 0.7 * frames);
    }
}

TEST(Walker, StandsStillAtSpeedZero) {
    WalkParameters parameters;
    parameters.gait.speed = 0.0;
    Walker walker = make_walker(parameters);
    const Pose2 start = walker.pose();
    walker.advance(10.0);
    EXPECT_EQ(walker.pose().x, start.x);
    EXPECT_EQ(walker.pose().y, start.y);
    EXPECT_EQ(walker.odometry().x, 0.0);
    EXPECT_NEAR(walker.T_BC().translation().z(), 0.42, 1e-12);
}

TEST(Walker, WithoutSlipOdometryIsExact) {
    WalkParameters parameters;
    parameters.odometry = {
        .translation_noise = 0.0, .rotation_noise = 0.0, .constant_share = 0.4, .heading_slip = 0.0};
    Walker walker = make_walker(parameters);
    const Pose2 start = walker.pose();
    walker.advance(73.123);
    const Pose2 counted = compose(start, walker.odometry());
    EXPECT_NEAR(counted.x, walker.pose().x, 1e-6);
    EXPECT_NEAR(counted.y, walker.pose().y, 1e-6);
    EXPECT_NEAR(wrap_angle(counted.theta - walker.pose().theta), 0.0, 1e-9);
}

struct Spread {
    double mean = 0.0, sigma = 0.0;
};
template <class F>
Spread spread(int runs, F value) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < runs; ++i) {
        const double v = value(i);
        sum += v;
        squares += v * v;
    }
    const double mean = sum / runs;
    return {mean, std::sqrt(squares / runs - mean * mean)};
}

TEST(OdometryModel, OneStepErrsByTheStatedSigma) {
    constexpr int runs = 8000;
    const auto after = [](int seed, const Pose2& step) {
        OdometryModel model({.heading_slip = 0.0}, Random(static_cast<std::uint64_t>(seed)));
        model.move(step, 0);
        return model.pose();
    };
    const Spread ahead = spread(runs, [&](int i) { return after(i, {0.05, 0, 0}).x / 0.05; });
    EXPECT_NEAR(ahead.mean, 1.0, 0.01);
    EXPECT_NEAR(ahead.sigma, 0.2, 0.008);
    const Spread aside = spread(runs, [&](int i) { return after(i, {0.05, 0, 0}).y / 0.05; });
    EXPECT_NEAR(aside.mean, 0.0, 0.01);
    EXPECT_NEAR(aside.sigma, 0.2, 0.008);
    const Spread turn = spread(runs, [&](int i) { return after(i, {0, 0, 0.1}).theta / 0.1; });
    EXPECT_NEAR(turn.mean, 1.0, 0.015);
    EXPECT_NEAR(turn.sigma, 0.3, 0.012);
}

TEST(OdometryModel, ManyStepsKeepTheConstantShareAndAverageTheRest) {
    constexpr int runs = 3000;
    constexpr int steps = 100;
    const Spread ahead = spread(runs, [&](int seed) {
        OdometryModel model({.heading_slip = 0.0}, Random(static_cast<std::uint64_t>(seed)));
        for (int i = 0; i < steps; ++i)
            for (int part = 0; part < 3; ++part) model.move({0.05 / 3.0, 0, 0}, i);
        return model.pose().x / (0.05 * steps);
    });
    const double expected = 0.2 * std::sqrt(0.4 * 0.4 + (1.0 - 0.4 * 0.4) / steps);
    EXPECT_NEAR(ahead.sigma, expected, 0.05 * expected);
    EXPECT_NEAR(ahead.mean, 1.0, 0.01);
}

TEST(OdometryModel, HeadingWandersWithTheDistance) {
    constexpr int runs = 3000;
    constexpr int steps = 100;
    const Spread heading = spread(runs, [&](int seed) {
        OdometryModel model({.heading_slip = 0.1}, Random(static_cast<std::uint64_t>(seed)));
        for (int i = 0; i < steps; ++i) model.move({0.05, 0, 0}, i);
        return model.pose().theta;
    });
    EXPECT_NEAR(heading.sigma, 0.1 * 0.05 * std::sqrt(steps), 0.003);
    EXPECT_NEAR(heading.mean, 0.0, 0.005);
}

TEST(KinematicsModel, ErrsByItsSigmas) {
    const Eigen::Isometry3d T_BC = camera_in_body(0.42, 0.05, 0.2, 0.7);
    const KinematicsParameters parameters{.angle_noise = 0.02, .angle_bias = 0.03, .position_noise = 0.004};
    // About one axis of B, over runs: noise and bias together.
    const auto error = [&](int seed) {
        const KinematicsModel model(parameters, Random(static_cast<std::uint64_t>(seed)));
        Random frame(static_cast<std::uint64_t>(seed) + 1000000U);
        const Eigen::Isometry3d measured = model.measure(T_BC, frame);
        const Eigen::AngleAxisd turn(measured.linear() * T_BC.linear().transpose());
        return std::pair<Eigen::Vector3d, Eigen::Vector3d>(turn.angle() * turn.axis(),
                                                           measured.translation() - T_BC.translation());
    };
    for (int axis = 0; axis < 3; ++axis) {
        const Spread angle = spread(4000, [&](int i) { return error(i).first[axis]; });
        EXPECT_NEAR(angle.sigma, std::hypot(0.02, 0.03), 0.0015);
        EXPECT_NEAR(angle.mean, 0.0, 0.002);
        const Spread position = spread(4000, [&](int i) { return error(i).second[axis]; });
        EXPECT_NEAR(position.sigma, 0.004, 0.0002);
    }
    const auto covariance = KinematicsModel(parameters, Random(1)).covariance();
    EXPECT_NEAR(covariance(0, 0), 0.004 * 0.004, 1e-12);
    EXPECT_NEAR(covariance(5, 5), 0.02 * 0.02 + 0.03 * 0.03, 1e-12);
}

TEST(KinematicsModel, BiasStaysForTheRun) {
    const KinematicsModel model({.angle_noise = 0.0, .angle_bias = 0.03, .position_noise = 0.0}, Random(5));
    const Eigen::Isometry3d T_BC = camera_in_body(0.42, 0.0, 0.2);
    Random one(1), other(2);
    EXPECT_EQ(model.measure(T_BC, one).matrix(), model.measure(T_BC, other).matrix());
    EXPECT_NE(model.measure(T_BC, one).matrix(), T_BC.matrix());
}

}  // namespace
}  // namespace goalmouth
