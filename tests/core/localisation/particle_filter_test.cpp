#include "core/localisation/particle_filter.h"

#include "core/localisation/pose_candidates.h"
#include "tests/core/localisation/world.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::heading_error;
using test::ObservationNoise;
using test::position_error;
using test::Walker;

constexpr double frame_time = 1.0 / 30;

/// A robot on a circle that sweeps its head about a goal, and the filter that follows it.
struct Trial {
    Field field;
    FilterParameters parameters;
    Pose2 start{-1.8, 2.0, -1.5708};
    ObservationNoise noise{0.03, 0.10, 0.5};
    bool distances = true;
    bool posts = true;
    std::optional<double> refined_yaw;  // posts are refined; σ of the camera's yaw, new in every frame
    double field_of_view = 1.05;
    Pose2 velocity{0.15, 0.0, 0.12};

    Random random{99};
    std::optional<Walker> walker;
    std::optional<ParticleFilter> filter;
    int frame = 0;

    void begin(std::uint64_t seed) {
        random = Random(seed);
        walker.emplace(field, start, seed + 1000);
        filter.emplace(field, parameters);
        filter->start(random);
        frame = 0;
    }

    PoseEstimate step() {
        const Pose2 step{velocity.x * frame_time, velocity.y * frame_time, velocity.theta * frame_time};
        filter->predict(walker->walk(step, frame_time, parameters.motion), random);
        FrameObservation seen;
        const double look = walker->goal_azimuth() + 0.5 * std::sin(frame * 0.05);
        if (posts) seen = walker->look(look, field_of_view / 2, frame_time, noise, distances);
        if (refined_yaw) {
            const double error = *refined_yaw * walker->random().normal();
            for (PostObservation& z : seen.posts) {
                z.refined = true;
                z.azimuth = wrap_angle(z.azimuth + error);
                z.common_azimuth_variance = *refined_yaw * *refined_yaw;
                z.covariance(0, 0) += z.common_azimuth_variance;
            }
        }
        filter->update(seen, frame == 0 ? 0.0 : frame_time, random);
        ++frame;
        return filter->estimate();
    }

    PoseEstimate steps(int count) {
        PoseEstimate e;
        for (int i = 0; i < count; ++i) e = step();
        return e;
    }
};

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

TEST(ParticleFilter, ConvergesFromThePapersStart) {
    std::vector<double> positions;
    std::vector<double> headings;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Trial trial;
        if (seed % 2 == 1) trial.start = {-1.8, -2.0, 1.5708};
        trial.begin(seed);
        trial.steps(300);
        std::vector<double> position;
        std::vector<double> heading;
        for (int i = 0; i < 300; ++i) {
            const PoseEstimate e = trial.step();
            position.push_back(position_error(e.pose, trial.walker->pose()));
            heading.push_back(heading_error(e.pose, trial.walker->pose()));
        }
        positions.push_back(median(position));
        headings.push_back(median(heading));
        EXPECT_LT(positions.back(), 0.8) << "seed " << seed;
        EXPECT_LT(headings.back(), 0.3) << "seed " << seed;
    }
    // A single frame of these measurements is good for 0.3 m at 3 m, and a metre's walk adds 0.2 m.
    EXPECT_LT(median(positions), 0.25);
    EXPECT_LT(median(headings), 0.1);
}

/// The camera's yaw may be known badly, or so well that no particle lies within a measurement's errors.
class RefinedPosts : public testing::TestWithParam<double> {};

TEST_P(RefinedPosts, GiveAPoseToCentimetres) {
    std::vector<double> positions;
    std::vector<double> headings;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Trial trial;
        trial.noise = {0.004, 0.008, 0.3};
        trial.refined_yaw = GetParam();
        trial.parameters.sensor.correlation_time = 0.3;
        trial.parameters.motion.translation_noise = 0.1;
        trial.parameters.motion.rotation_noise = 0.1;
        trial.parameters.motion.drift = 0.03;
        trial.begin(seed);
        trial.steps(150);
        for (int i = 0; i < 300; ++i) {
            const PoseEstimate e = trial.step();
            positions.push_back(position_error(e.pose, trial.walker->pose()));
            headings.push_back(heading_error(e.pose, trial.walker->pose()));
            ASSERT_LT(positions.back(), 0.6) << "seed " << seed << ", frame " << trial.frame;
        }
        EXPECT_LT(trial.filter->injected(), 20) << "seed " << seed;
    }
    EXPECT_LT(median(positions), 0.08);
    EXPECT_LT(median(headings), 0.03);
}

INSTANTIATE_TEST_SUITE_P(YawSigma, RefinedPosts, testing::Values(0.0, 0.001, 0.025));

TEST(ParticleFilter, GoodMeasurementsGiveAGoodPose) {
    std::vector<double> positions;
    std::vector<double> headings;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Trial trial;
        trial.noise = {0.015, 0.05, 0.3};
        trial.parameters.sensor.correlation_time = 0.3;
        trial.parameters.motion.translation_noise = 0.1;
        trial.parameters.motion.rotation_noise = 0.1;
        trial.parameters.motion.drift = 0.03;
        trial.begin(seed);
        trial.steps(300);
        for (int i = 0; i < 200; ++i) {
            const PoseEstimate e = trial.step();
            positions.push_back(position_error(e.pose, trial.walker->pose()));
            headings.push_back(heading_error(e.pose, trial.walker->pose()));
        }
    }
    EXPECT_LT(median(positions), 0.15);
    EXPECT_LT(median(headings), 0.05);
}

TEST(ParticleFilter, ConvergesFromAnywhereInTheOwnHalf) {
    int good = 0;
    Random where(5);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Trial trial;
        trial.parameters.initial.kind = "own_half";
        trial.start = {where.uniform(-2.5, -0.8), where.uniform(-1.5, 1.5), where.uniform(-3, 3)};
        trial.velocity = {0.05, 0.0, 0.1};
        trial.begin(seed);
        const PoseEstimate e = trial.steps(450);
        good += position_error(e.pose, trial.walker->pose()) < 0.4 &&
                heading_error(e.pose, trial.walker->pose()) < 0.25;
    }
    EXPECT_GE(good, 8);
}

TEST(ParticleFilter, KidnappedRobotIsFoundAgain) {
    int good = 0;
    int among = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Trial trial;
        trial.begin(seed);
        trial.steps(300);
        const Pose2 old = trial.walker->pose();
        trial.walker->put({0.8, -0.9, wrap_angle(old.theta + 0.6)});
        trial.velocity = {0.05, 0.0, 0.1};
        const PoseEstimate e = trial.steps(450);
        const auto near = [&](const Pose2& p) {
            return position_error(p, trial.walker->pose()) < 0.5 &&
                   heading_error(p, trial.walker->pose()) < 0.3;
        };
        good += near(e.pose);
        // The mirror image explains all the same: the truth must be among the hypotheses, and mostly the
        // heaviest.
        among += std::any_of(e.hypotheses.begin(), e.hypotheses.end(),
                             [&](const auto& h) { return near(h.pose); });
        EXPECT_GT(trial.filter->injected(), 0);
    }
    EXPECT_GE(among, 9);
    EXPECT_GE(good, 7);
}

TEST(ParticleFilter, NothingIsInjectedWhileTheBeliefExplainsWhatIsSeen) {
    Trial trial;
    trial.begin(3);
    trial.steps(150);
    const auto before = trial.filter->injected();
    trial.steps(600);
    EXPECT_EQ(trial.filter->injected(), before);
    EXPECT_GT(trial.filter->fit(), 0.6);
}

TEST(ParticleFilter, SymmetricPriorStaysTwoHypotheses) {
    int two = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Trial trial;
        const Pose2 other = mirrored(trial.start);
        trial.parameters.initial.x = {trial.start.x, other.x};
        trial.parameters.initial.y = {trial.start.y, other.y};
        trial.parameters.initial.theta = {trial.start.theta, other.theta};
        trial.parameters.initial.elsewhere_share = 0.0;
        trial.begin(seed);
        const PoseEstimate e = trial.steps(300);
        if (e.hypotheses.size() < 2) continue;
        const bool mirror = position_error(mirrored(e.hypotheses[0].pose), e.hypotheses[1].pose) < 0.6 &&
                            heading_error(mirrored(e.hypotheses[0].pose), e.hypotheses[1].pose) < 0.4;
        const bool balanced = e.hypotheses[1].weight > 0.1;
        const bool one_is_true = position_error(e.hypotheses[0].pose, trial.walker->pose()) < 0.8 ||
                                 position_error(e.hypotheses[1].pose, trial.walker->pose()) < 0.8;
        two += mirror && balanced && one_is_true;
    }
    EXPECT_GE(two, 7);
}

TEST(ParticleFilter, BearingsAloneLocalise) {
    std::vector<double> positions;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Trial trial;
        trial.distances = false;
        trial.begin(seed);
        trial.steps(300);
        std::vector<double> position;
        for (int i = 0; i < 300; ++i)
            position.push_back(position_error(trial.step().pose, trial.walker->pose()));
        positions.push_back(median(position));
    }
    EXPECT_LT(median(positions), 0.5);
}

TEST(ParticleFilter, WithoutPostsTheCovarianceGrowsWithTheWalk) {
    Trial trial;
    trial.begin(1);
    trial.steps(300);
    trial.posts = false;
    double before = trial.filter->estimate().covariance.topLeftCorner<2, 2>().trace();
    for (int i = 0; i < 4; ++i) {
        const PoseEstimate e = trial.steps(60);
        const double now = summarise(trial.filter->particles()).covariance.topLeftCorner<2, 2>().trace();
        EXPECT_GT(now, before);
        EXPECT_EQ(e.posts_used, 0);
        before = now;
    }
}

TEST(ParticleFilter, CovarianceIsHonest) {
    // Normalised estimation error squared per degree of freedom, 1 for a covariance that is exactly right.
    // Errors of the observations persist as the model supposes (first-order, correlation_time).
    double sum = 0.0;
    int count = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Trial trial;
        trial.begin(seed);
        trial.steps(200);
        for (int i = 0; i < 10; ++i) {
            const PoseEstimate e = trial.steps(30);
            const Pose2& t = trial.walker->pose();
            const Eigen::Vector3d d(e.pose.x - t.x, e.pose.y - t.y, wrap_angle(e.pose.theta - t.theta));
            if (e.hypotheses.front().weight < 0.8)
                continue;  // the error of a belief of two minds is not one Gaussian's
            sum += d.dot(e.covariance.ldlt().solve(d)) / 3.0;
            ++count;
        }
    }
    ASSERT_GT(count, 300);
    RecordProperty("nees", std::to_string(sum / count));
    EXPECT_GT(sum / count, 0.5);
    EXPECT_LT(sum / count, 3.0);
}

TEST(ParticleFilter, ClutterIsRejectedAndCounted) {
    Trial trial;
    trial.begin(2);
    trial.steps(300);
    FrameObservation frame =
        trial.walker->look(trial.walker->goal_azimuth(), 0.5, frame_time, {0.02, 0.05, 0.0});
    const int real = static_cast<int>(frame.posts.size());
    ASSERT_GE(real, 1);
    PostObservation ghost = frame.posts[0];
    ghost.azimuth += 0.5;
    ghost.inverse_distance = 1.2;
    frame.posts.push_back(ghost);
    frame.unusable = 1;
    trial.filter->update(frame, frame_time, trial.random);
    const PoseEstimate e = trial.filter->estimate();
    EXPECT_EQ(e.posts_used, real);
    EXPECT_EQ(e.posts_rejected, 2);
}

TEST(ParticleFilter, StaysFiniteWhateverIsSeen) {
    Random random(17);
    for (int pass = 0; pass < 20; ++pass) {
        FilterParameters parameters;
        parameters.particles = 50;
        ParticleFilter filter(Field{}, parameters);
        filter.start(random);
        for (int i = 0; i < 100; ++i) {
            FrameObservation frame;
            frame.camera = {random.uniform(-1, 1), random.uniform(-1, 1)};
            for (std::uint32_t k = random.index(6); k > 0; --k) {
                PostObservation z;
                z.azimuth = random.uniform(-10, 10);
                z.has_distance = random.index(2) == 0;
                z.inverse_distance =
                    random.index(3) == 0 ? 10.0 : random.uniform(0.001, 20);  // a post at 0.1 m
                z.covariance << std::pow(10, random.uniform(-8, 0)), 0, 0,
                    std::pow(10, random.uniform(-8, 0));
                z.side = static_cast<PostSide>(random.index(3));
                frame.posts.push_back(z);
            }
            Motion motion;
            motion.seconds = random.uniform(0, 2);
            motion.known = random.index(2) == 0;
            if (motion.known)
                motion.step = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-4, 4)};
            filter.predict(motion, random);
            filter.update(frame, motion.seconds, random);
            const PoseEstimate e = filter.estimate();
            ASSERT_FALSE(e.hypotheses.empty());
            ASSERT_TRUE(std::isfinite(e.pose.x) && std::isfinite(e.pose.y) && std::isfinite(e.pose.theta));
            ASSERT_TRUE(e.covariance.allFinite());
            ASSERT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(e.covariance).eigenvalues().minCoeff(),
                      0.0);
            ASSERT_GE(e.effective_sample_size, 1.0 - 1e-9);
            ASSERT_LE(e.effective_sample_size, 2000.0 + 1e-6);
            double sum = 0.0;
            for (const Particle& p : filter.particles()) sum += p.weight;
            ASSERT_NEAR(sum, 1.0, 1e-9);
        }
    }
}

TEST(ParticleFilter, AllParticlesFarOffAreStillABelief) {
    FilterParameters parameters;
    parameters.initial.x = {90};
    parameters.initial.y = {-90};
    parameters.initial.theta = {0};
    parameters.initial.elsewhere_share = 0.0;
    Trial trial;
    trial.parameters = parameters;
    trial.begin(4);
    trial.parameters = {};
    const PoseEstimate e = trial.steps(600);
    EXPECT_LT(std::hypot(e.pose.x, e.pose.y), 6.0) << "injected poses take over";
}

TEST(ParticleFilter, SameSeedSameBelief) {
    Trial a;
    Trial b;
    a.begin(7);
    b.begin(7);
    const PoseEstimate ea = a.steps(120);
    const PoseEstimate eb = b.steps(120);
    EXPECT_EQ(ea.pose.x, eb.pose.x);
    EXPECT_EQ(ea.pose.theta, eb.pose.theta);
    EXPECT_EQ(ea.covariance, eb.covariance);
    Trial c;
    c.begin(8);
    EXPECT_NE(c.steps(120).pose.x, ea.pose.x);
}

TEST(ParticleFilter, StartPosesThatDoNotFitTogetherAreRefused) {
    FilterParameters parameters;
    parameters.initial.y = {1.0};
    EXPECT_THROW(ParticleFilter(Field{}, parameters), std::invalid_argument);
}

}  // namespace
}  // namespace goalmouth
