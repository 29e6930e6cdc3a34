#include "core/localisation/sensor_model.h"

#include "core/localisation/pose_candidates.h"
#include "tests/core/localisation/world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::ObservationNoise;
using test::Walker;

Pose2 random_pose(Random& random) {
    return {random.uniform(-3.5, 3.5), random.uniform(-2.5, 2.5), random.uniform(-3.14, 3.14)};
}

/// The sum over one-to-one assignments, written out.
double brute_force(const Pose2& pose, const FrameObservation& frame, const Field& field,
                   const SensorModelParameters& p) {
    const Eigen::Vector2d camera = transform(pose, frame.camera);
    std::function<double(std::size_t, unsigned)> rest = [&](std::size_t i, unsigned taken) -> double {
        if (i == frame.posts.size()) return 1.0;
        const PostObservation& z = frame.posts[i];
        double clutter = p.clutter_share / p.clutter_azimuth_range;
        if (z.has_distance) clutter /= p.clutter_inverse_distance_range;
        double sum = clutter * rest(i + 1, taken);
        for (unsigned k = 0; k < 4; ++k) {
            if (taken & (1U << k)) continue;
            const Eigen::Vector2d d = field.posts()[k] - camera;
            const double da = wrap_angle(z.azimuth - (std::atan2(d.y(), d.x()) - pose.theta));
            double density;
            if (z.has_distance) {
                const Eigen::Vector2d e(da, z.inverse_distance - 1.0 / d.norm());
                density = std::exp(-0.5 * e.dot(z.covariance.inverse() * e)) /
                          (2 * std::numbers::pi * std::sqrt(z.covariance.determinant()));
            } else {
                density = std::exp(-0.5 * da * da / z.covariance(0, 0)) /
                          std::sqrt(2 * std::numbers::pi * z.covariance(0, 0));
            }
            double side = 0.5;
            if (z.side == PostSide::left)
                side = (k == 1 || k == 2) ? 1 - p.wrong_side_share : p.wrong_side_share;
            if (z.side == PostSide::right)
                side = (k == 0 || k == 3) ? 1 - p.wrong_side_share : p.wrong_side_share;
            sum += (1 - p.clutter_share) * side * density / 4 * rest(i + 1, taken | (1U << k));
        }
        return sum;
    };
    return rest(0, 0);
}

TEST(SensorModel, SumsOverAllOneToOneAssignments) {
    const Field field;
    const SensorModelParameters p;
    const SensorModel model(field, p);
    Random random(1);
    for (int trial = 0; trial < 300; ++trial) {
        const Pose2 truth = random_pose(random);
        Walker walker(field, truth, 100 + static_cast<std::uint64_t>(trial));
        FrameObservation frame = walker.look(0, 3.2, 1.0, {0.1, 0.3, 0.0}, trial % 3 != 0);
        frame.posts.resize(random.index(5));
        for (PostObservation& z : frame.posts) {
            z.side = static_cast<PostSide>(random.index(3));
            if (z.has_distance)
                z.covariance(0, 1) = z.covariance(1, 0) =
                    0.3 * std::sqrt(z.covariance(0, 0) * z.covariance(1, 1));
        }
        const Pose2 near{truth.x + 0.2 * random.normal(), truth.y + 0.2 * random.normal(),
                         truth.theta + 0.1 * random.normal()};
        EXPECT_NEAR(model.likelihood(near, frame).log, std::log(brute_force(near, frame, field, p)), 1e-9);
    }
}

TEST(SensorModel, ExplainedIsTheProbabilityThatAnObservationIsNoClutter) {
    const Field field;
    const SensorModel model(field, {});
    Walker walker(field, {-1.0, 0.3, 0.1}, 5);
    FrameObservation frame = walker.look(0, 3.2, 1.0, {0.02, 0.05, 0.0});
    ASSERT_EQ(frame.posts.size(), 4U);
    PostObservation nowhere = frame.posts[0];
    nowhere.azimuth = 1.5;
    nowhere.inverse_distance = 1.4;
    frame.posts.push_back(nowhere);
    const auto l = model.likelihood(walker.pose(), frame);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(l.explained_each[i], 0.8);
    EXPECT_LT(l.explained_each[4], 0.01);
    EXPECT_EQ(model.likelihood(walker.pose(), {}).explained, 1.0);
    EXPECT_EQ(model.likelihood(walker.pose(), {}).log, 0.0);
}

TEST(SensorModel, TwoPostsSeenAreTwoPosts) {
    // Two observations of the same direction: the pose that explains both by one post must not win over
    // clutter.
    const Field field;
    const SensorModel model(field, {});
    Walker walker(field, {-1.0, 0.3, 0.1}, 5);
    FrameObservation frame = walker.look(0, 0.6, 1.0, {0.02, 0.05, 0.0});
    ASSERT_GE(frame.posts.size(), 1U);
    frame.posts.resize(1);
    frame.posts.push_back(frame.posts[0]);
    const auto l = model.likelihood(walker.pose(), frame);
    EXPECT_LT(l.explained, 0.6);
}

TEST(SensorModel, BeliefIsPointSymmetric) {
    const Field field;
    const SensorModel model(field, {});
    Random random(2);
    for (int trial = 0; trial < 100; ++trial) {
        Walker walker(field, random_pose(random), 7 + static_cast<std::uint64_t>(trial));
        FrameObservation frame = walker.look(0, 1.5, 1.0, {});
        for (PostObservation& z : frame.posts) z.side = static_cast<PostSide>(random.index(3));
        const Pose2 pose = random_pose(random);
        EXPECT_NEAR(model.likelihood(pose, frame).log, model.likelihood(mirrored(pose), frame).log, 1e-9);
    }
}

TEST(SensorModel, SideDecidesBetweenTheTwoPostsOfAGoal) {
    const Field field;
    const SensorModel model(field, {});
    const Pose2 pose{1.0, 0.0, 0.0};
    const Eigen::Vector2d left = field.posts()[2];  // y > 0 at the opponents' goal
    FrameObservation frame;
    PostObservation z;
    z.azimuth = std::atan2(left.y(), left.x() - 1.0);
    z.has_distance = true;
    z.inverse_distance = 1.0 / (left - Eigen::Vector2d(1.0, 0.0)).norm();
    z.covariance << 4e-4, 0, 0, 4e-4;
    frame.posts = {z};
    const double unknown = model.likelihood(pose, frame).log;
    frame.posts[0].side = PostSide::left;
    EXPECT_GT(model.likelihood(pose, frame).log, unknown + 0.5);
    frame.posts[0].side = PostSide::right;
    EXPECT_LT(model.likelihood(pose, frame).log, unknown - 2.0);
}

TEST(SensorModel, StaysFiniteWherePosesAndPostsMakeNoSense) {
    const Field field;
    const SensorModel model(field, {});
    FrameObservation frame;
    PostObservation z;
    z.has_distance = true;
    z.covariance << 1e-6, 0, 0, 1e-10;
    for (const double inverse : {1e-3, 0.3, 10.0, 19.0}) {
        z.inverse_distance = inverse;
        frame.posts.assign(9, z);  // more than are weighed
        for (const Eigen::Vector2d& post : field.posts()) {
            const auto l = model.likelihood({post.x(), post.y(), 0.0}, frame);  // the camera stands in a post
            EXPECT_TRUE(std::isfinite(l.log));
            EXPECT_TRUE(std::isfinite(l.explained));
        }
        EXPECT_TRUE(std::isfinite(model.likelihood({1e6, -1e6, 100.0}, frame).log));
    }
}

/// The same sum with each assignment's normal density of all its azimuths and inverse distances together, the
/// common error as correlation between azimuths.
double brute_force_with_common_error(const Pose2& pose, const FrameObservation& frame, const Field& field,
                                     const SensorModelParameters& p) {
    const Eigen::Vector2d camera = transform(pose, frame.camera);
    std::vector<int> taken;  // post of each observation, −1 for clutter
    std::function<double()> rest = [&]() -> double {
        if (taken.size() < frame.posts.size()) {
            double sum = 0.0;
            for (int k = -1; k < 4; ++k) {
                if (k >= 0 && std::count(taken.begin(), taken.end(), k) > 0) continue;
                taken.push_back(k);
                sum += rest();
                taken.pop_back();
            }
            return sum;
        }
        double factor = 1.0;
        std::vector<double> residuals;
        std::vector<std::pair<std::size_t, int>> what;  // observation, 0 azimuth or 1 inverse distance
        for (std::size_t i = 0; i < taken.size(); ++i) {
            const PostObservation& z = frame.posts[i];
            if (taken[i] < 0) {
                factor *= p.clutter_share / p.clutter_azimuth_range /
                          (z.has_distance ? p.clutter_inverse_distance_range : 1.0);
                continue;
            }
            factor *= (1 - p.clutter_share) * 0.5 / 4;
            const Eigen::Vector2d d = field.posts()[static_cast<std::size_t>(taken[i])] - camera;
            residuals.push_back(wrap_angle(z.azimuth - (std::atan2(d.y(), d.x()) - pose.theta)));
            what.emplace_back(i, 0);
            if (!z.has_distance) continue;
            residuals.push_back(z.inverse_distance - 1.0 / d.norm());
            what.emplace_back(i, 1);
        }
        const auto n = static_cast<Eigen::Index>(residuals.size());
        if (n == 0) return factor;
        Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n);
        for (Eigen::Index a = 0; a < n; ++a) {
            for (Eigen::Index b = 0; b < n; ++b) {
                const auto [i, u] = what[static_cast<std::size_t>(a)];
                const auto [j, v] = what[static_cast<std::size_t>(b)];
                if (i == j) {
                    C(a, b) = frame.posts[i].covariance(u, v);
                } else if (u == 0 && v == 0) {
                    C(a, b) = std::sqrt(frame.posts[i].common_azimuth_variance *
                                        frame.posts[j].common_azimuth_variance);
                }
            }
        }
        const Eigen::Map<const Eigen::VectorXd> e(residuals.data(), n);
        return factor * std::exp(-0.5 * e.dot(C.inverse() * e)) /
               std::sqrt(std::pow(2 * std::numbers::pi, static_cast<double>(n)) * C.determinant());
    };
    return rest();
}

TEST(SensorModel, AnErrorInCommonIsACorrelationBetweenAzimuths) {
    const Field field;
    const SensorModelParameters p;
    const SensorModel model(field, p);
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const Pose2 truth = random_pose(random);
        Walker walker(field, truth, 300 + static_cast<std::uint64_t>(trial));
        FrameObservation frame = walker.look(0, 3.2, 1.0, {0.03, 0.1, 0.0}, trial % 3 != 0);
        frame.posts.resize(1 + random.index(4));
        for (std::size_t i = 0; i < frame.posts.size(); ++i) {
            PostObservation& z = frame.posts[i];
            if (z.has_distance)
                z.covariance(0, 1) = z.covariance(1, 0) =
                    0.3 * std::sqrt(z.covariance(0, 0) * z.covariance(1, 1));
            if (i == 1 && trial % 2 == 0) continue;  // one that is not refined
            z.common_azimuth_variance = 0.02;
            z.covariance(0, 0) += 0.02;
        }
        const Pose2 near{truth.x + 0.2 * random.normal(), truth.y + 0.2 * random.normal(),
                         truth.theta + 0.2 * random.normal()};
        const auto l = model.likelihood(near, frame);
        EXPECT_NEAR(l.log, std::log(brute_force_with_common_error(near, frame, field, p)), 1e-6) << trial;
        EXPECT_GE(l.explained, 0.0);
        EXPECT_LE(l.explained, 1.0 + 1e-12);
    }
}

TEST(SensorModel, AnErrorOfOneObservationIsInCommonWithNobody) {
    const Field field;
    const SensorModel model(field, {});
    Walker walker(field, {-1.0, 0.3, 0.1}, 5);
    FrameObservation frame = walker.look(0, 0.6, 1.0, {0.05, 0.05, 0.0});
    frame.posts.resize(1);
    const auto alone = model.likelihood({-1.1, 0.2, 0.2}, frame);
    frame.posts[0].common_azimuth_variance = 0.6 * frame.posts[0].covariance(0, 0);
    const auto common = model.likelihood({-1.1, 0.2, 0.2}, frame);
    EXPECT_NEAR(common.log, alone.log, 1e-9);
    EXPECT_NEAR(common.explained, alone.explained, 1e-9);
    EXPECT_NEAR(common.explained_each[0], alone.explained_each[0], 1e-9);
}

TEST(SensorModel, TheAngleBetweenPostsTellsThePlaceWhateverTheYaw) {
    // Three posts of which only the directions are known, and those but for a common turn of 0.1 rad.
    const Field field;
    const SensorModel model(field, {});
    const Pose2 truth{-0.8, 0.4, 0.0};
    FrameObservation frame;
    for (const std::size_t k : {0U, 2U, 3U}) {
        const Eigen::Vector2d d = field.posts()[k] - truth.position();
        PostObservation z;
        z.azimuth = std::atan2(d.y(), d.x()) + 0.1;
        z.common_azimuth_variance = 0.05 * 0.05;
        z.covariance(0, 0) = z.common_azimuth_variance + 0.003 * 0.003;
        frame.posts.push_back(z);
    }
    const double here = model.likelihood(truth, frame).log;
    for (const Eigen::Vector2d& off : {Eigen::Vector2d(0.1, 0), Eigen::Vector2d(-0.1, 0),
                                       Eigen::Vector2d(0, 0.1), Eigen::Vector2d(0, -0.1)})
        EXPECT_LT(model.likelihood({truth.x + off.x(), truth.y + off.y(), 0.0}, frame).log, here - 3.0);
    EXPECT_LT(model.likelihood({truth.x, truth.y, -0.1}, frame).log, here + 2.5)
        << "the turn is an error like others";
}

TEST(SensorModel, StaysFiniteWithAnErrorInCommon) {
    const Field field;
    const SensorModel model(field, {});
    FrameObservation frame;
    PostObservation z;
    z.has_distance = true;
    z.common_azimuth_variance = 1e-3;
    z.covariance << 1e-3 + 1e-12, 0, 0, 1e-10;
    for (const double inverse : {1e-3, 0.3, 10.0, 19.0}) {
        z.inverse_distance = inverse;
        frame.posts.assign(9, z);
        for (const Eigen::Vector2d& post : field.posts()) {
            const auto l = model.likelihood({post.x(), post.y(), 0.0}, frame);
            EXPECT_TRUE(std::isfinite(l.log));
            EXPECT_TRUE(std::isfinite(l.explained));
        }
        EXPECT_TRUE(std::isfinite(model.likelihood({1e6, -1e6, 100.0}, frame).log));
    }
}

TEST(SensorModel, NewsOfAFrameGrowsWithTheTimeSinceTheLast) {
    SensorModelParameters p;
    p.correlation_time = 0.5;
    const SensorModel model(Field{}, p);
    EXPECT_EQ(model.news(0.0), 0.0);
    EXPECT_NEAR(model.news(1.0 / 30), 1.0 / 30, 1e-12);
    EXPECT_EQ(model.news(7.0), 1.0);
    p.correlation_time = 0.0;
    EXPECT_EQ(SensorModel(Field{}, p).news(0.001), 1.0);
}

TEST(SensorModel, NoRobotIsFarOffTheCarpet) {
    const SensorModel model(Field{}, {});
    EXPECT_EQ(model.log_place({3.6, -2.6, 0}), 0.0);
    EXPECT_LT(model.log_place({4.6, 0, 0}), -3.0);
    EXPECT_NEAR(model.log_place({0, 3.0, 0}), model.log_place({0, -3.0, 1}), 1e-12);
}

}  // namespace
}  // namespace goalmouth
