#include "core/localisation/localiser.h"

#include "tests/core/localisation/world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::body_in_field;
using test::heading_error;
using test::position_error;
using test::see_post;
using test::Walker;

using Event = std::variant<PostsFrame, OdometrySample, KinematicsSample>;

std::int64_t utime_of(const Event& event) {
    return std::visit([](const auto& e) { return e.utime; }, event);
}

Random random_for(std::int64_t seq) {
    return random_for_frame(42, "localisation", seq);
}

/// What a walk sends, from images on: posts as a detector finds them in the picture of a rolling, panning
/// camera.
struct Log {
    std::vector<Event> events;  // in the order of their times
    std::vector<Pose2> truth;   // of each frame
};

struct Sent {
    bool odometry = true;
    bool kinematics = true;
    std::int64_t start = 1'000'000'000;
    int frames = 450;
    int odometry_per_frame = 3;
    Pose2 velocity{0.12, 0.0, 0.1};
};

Log record(const Sent& sent, std::uint64_t seed) {
    Log log;
    const Field field;
    const Intrinsics intrinsics;
    const MotionParameters motion;
    Walker walker(field, {-1.8, 2.0, -1.5708}, seed);
    Pose2 odometry{3, 4, 1};
    Random& random = walker.random();
    const double part = 1.0 / 30 / sent.odometry_per_frame;
    for (int i = 0; i < sent.frames; ++i) {
        const std::int64_t utime = sent.start + i * 33333;
        for (int k = 0; k < sent.odometry_per_frame; ++k) {
            const Pose2 step{sent.velocity.x * part, sent.velocity.y * part, sent.velocity.theta * part};
            if (i > 0) odometry = compose(odometry, walker.walk(step, part, motion).step);
            const std::int64_t at =
                utime - (sent.odometry_per_frame - 1 - k) * 11111 + 2000;  // never at the frame's own time
            if (sent.odometry) log.events.push_back(OdometrySample{at, odometry, -1, -1, 0});
        }
        log.truth.push_back(walker.pose());
        const double pan = walker.goal_azimuth() + 0.4 * std::sin(0.05 * i);
        KinematicsSample kinematics;
        kinematics.utime = utime;
        kinematics.camera.T_BC = camera_in_body(0.45, 0.1 * std::sin(0.3 * i), 0.1, pan);
        kinematics.camera.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 4e-4, 4e-4, 4e-4;
        if (sent.kinematics) log.events.push_back(kinematics);
        PostsFrame frame{utime, i, intrinsics, {}};
        const Eigen::Isometry3d T_WC = body_in_field(walker.pose()) * kinematics.camera.T_BC;
        for (const Eigen::Vector2d& axis : field.posts()) {
            auto post = see_post(axis, field.post_diameter / 2, 0.0, 0.9, T_WC, intrinsics);
            if (!post) continue;
            const double middle = 0.5 * (post->left_base.x() + post->right_base.x());
            if (middle < 0 || middle > 640) continue;
            for (Eigen::Vector2d* p :
                 {&post->left_top, &post->left_base, &post->right_top, &post->right_base}) {
                *p += Eigen::Vector2d(random.normal(), 0.0);
            }
            post->width_px = std::max(1.0, post->width_px + 0.7 * random.normal());
            const double sigma = post->distance_m * 0.7 / post->width_px;
            post->covariance << sigma * sigma, 0, 0, 4e-6;
            frame.posts.push_back(*post);
        }
        log.events.push_back(frame);
    }
    std::stable_sort(log.events.begin(), log.events.end(),
                     [](const Event& a, const Event& b) { return utime_of(a) < utime_of(b); });
    return log;
}

std::vector<Localiser::Output> replay(Localiser& localiser, const std::vector<Event>& events) {
    std::vector<Localiser::Output> outputs;
    for (const Event& event : events) {
        for (auto& o : std::visit([&](const auto& e) { return localiser.add(e); }, event))
            outputs.push_back(std::move(o));
    }
    return outputs;
}

/// Each channel late by a delay of its own that varies, but in order within the channel.
std::vector<Event> delayed(const std::vector<Event>& events, double most, Random& random) {
    std::vector<std::pair<double, const Event*>> arrivals;
    double last[3] = {-1e18, -1e18, -1e18};
    for (const Event& event : events) {
        double& channel = last[event.index()];
        channel =
            std::max(channel + 1e-3, static_cast<double>(utime_of(event)) + 1e6 * most * random.uniform());
        arrivals.emplace_back(channel, &event);
    }
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Event> result;
    for (const auto& a : arrivals) result.push_back(*a.second);
    return result;
}

void expect_same(const PoseEstimate& a, const PoseEstimate& b) {
    EXPECT_EQ(a.utime, b.utime);
    EXPECT_EQ(a.seq, b.seq);
    EXPECT_EQ(a.pose.x, b.pose.x);
    EXPECT_EQ(a.pose.y, b.pose.y);
    EXPECT_EQ(a.pose.theta, b.pose.theta);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.effective_sample_size, b.effective_sample_size);
    ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
    for (std::size_t i = 0; i < a.hypotheses.size(); ++i)
        EXPECT_EQ(a.hypotheses[i].weight, b.hypotheses[i].weight);
}

double median_error(const std::vector<Localiser::Output>& outputs, const std::vector<Pose2>& truth,
                    std::size_t from) {
    std::vector<double> errors;
    for (const auto& o : outputs) {
        const auto i = static_cast<std::size_t>(o.estimate.seq);
        if (i >= from) errors.push_back(position_error(o.estimate.pose, truth[i]));
    }
    if (errors.empty()) return 1e9;
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() / 2];
}

TEST(Localiser, FollowsAWalkFromImagesToPose) {
    std::vector<double> errors;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Log log = record({}, seed);
        Localiser localiser(Field{}, {}, random_for);
        const auto outputs = replay(localiser, log.events);
        EXPECT_GE(outputs.size(), 449U);
        for (std::size_t i = 0; i < outputs.size(); ++i)
            EXPECT_EQ(outputs[i].estimate.seq, static_cast<std::int64_t>(i));
        errors.push_back(median_error(outputs, log.truth, 300));
        EXPECT_EQ(localiser.counters().without_odometry, 0);
        EXPECT_EQ(localiser.counters().without_kinematics, 0);
        EXPECT_GT(localiser.counters().posts_used, localiser.counters().posts_rejected);
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[2], 0.2);
    EXPECT_LT(errors[4], 0.5);
}

TEST(Localiser, OutputDoesNotDependOnHowChannelsInterleave) {
    Sent sent;
    sent.frames = 120;
    const Log log = record(sent, 3);
    Localiser first(Field{}, {}, random_for);
    const auto want = replay(first, log.events);
    ASSERT_GE(want.size(), 119U);
    Random random(11);
    for (int trial = 0; trial < 10; ++trial) {
        Localiser localiser(Field{}, {}, random_for);
        const auto got = replay(localiser, delayed(log.events, 0.15, random));
        ASSERT_EQ(got.size(), want.size());
        for (std::size_t i = 0; i < got.size(); ++i) {
            expect_same(got[i].estimate, want[i].estimate);
            ASSERT_EQ(got[i].particles.size(), want[i].particles.size());
        }
    }
}

TEST(Localiser, AMissingKinematicsMessageHoldsTheGraphUpForTheWaitOnly) {
    Sent sent;
    sent.frames = 60;
    Log log = record(sent, 4);
    std::erase_if(log.events, [](const Event& e) { return e.index() == 2 && utime_of(e) > 1'001'000'000; });
    Localiser localiser(Field{}, {}, random_for);
    const auto outputs = replay(localiser, log.events);
    EXPECT_GE(outputs.size(), 58U);
    EXPECT_GT(localiser.counters().without_kinematics, 10);
}

TEST(Localiser, WorksWithImagesAlone) {
    Sent sent;
    sent.odometry = false;
    sent.velocity = {0.02, 0, 0.02};
    const Log log = record(sent, 5);
    Localiser localiser(Field{}, {}, random_for);
    const auto outputs = replay(localiser, log.events);
    EXPECT_EQ(outputs.size(), log.truth.size());
    EXPECT_EQ(localiser.counters().without_odometry, static_cast<std::int64_t>(outputs.size()));
    EXPECT_LT(median_error(outputs, log.truth, 300), 0.5);

    sent.kinematics = false;
    const Log blind = record(sent, 5);
    Localiser without(Field{}, {}, random_for);
    const auto others = replay(without, blind.events);
    EXPECT_EQ(others.size(), blind.truth.size());
    EXPECT_EQ(without.counters().without_kinematics, static_cast<std::int64_t>(others.size()));
    for (const auto& o : others) ASSERT_TRUE(std::isfinite(o.estimate.pose.x));
}

TEST(Localiser, StartsAnewWhenTimeRunsBackwards) {
    Sent sent;
    sent.frames = 120;
    const Log log = record(sent, 6);
    Localiser localiser(Field{}, {}, random_for);
    const auto first = replay(localiser, log.events);
    const auto second = replay(localiser, log.events);
    EXPECT_GE(localiser.counters().restarts, 1);
    EXPECT_LE(localiser.counters().restarts, 3) << "once for each channel at most";
    ASSERT_FALSE(second.empty());
    // The replay begins from the prior, and ends where the first pass ended.
    EXPECT_LT(position_error(second.back().estimate.pose, log.truth.back()), 0.6);
    EXPECT_EQ(second.back().estimate.utime, first.back().estimate.utime);
    EXPECT_GE(second.size(), 110U);
}

TEST(Localiser, StartsAnewAfterAGapNothingBridges) {
    Sent sent;
    sent.frames = 60;
    Log log = record(sent, 7);
    sent.start += 60'000'000;
    const Log later = record(sent, 7);
    Localiser localiser(Field{}, {}, random_for);
    replay(localiser, log.events);
    const auto outputs = replay(localiser, later.events);
    EXPECT_EQ(localiser.counters().restarts, 1);
    EXPECT_FALSE(outputs.empty());
}

TEST(Localiser, GapThatOdometryBridgesIsNoNewStart) {
    Sent sent;
    sent.frames = 600;
    Log log = record(sent, 8);
    std::erase_if(log.events, [&](const Event& e) {
        return e.index() == 0 && utime_of(e) > sent.start + 5'000'000 &&
               utime_of(e) < sent.start + 12'000'000;
    });
    Localiser localiser(Field{}, {}, random_for);
    replay(localiser, log.events);
    EXPECT_EQ(localiser.counters().restarts, 0);
}

TEST(Localiser, OdometryThatJumpsIsNotBelieved) {
    Sent sent;
    Log log = record(sent, 9);
    for (Event& e : log.events) {
        if (auto* o = std::get_if<OdometrySample>(&e); o != nullptr && o->utime > sent.start + 10'000'000) {
            o->pose = compose({50, -20, 2}, o->pose);  // the step counter was restarted
        }
    }
    Localiser localiser(Field{}, {}, random_for);
    const auto outputs = replay(localiser, log.events);
    EXPECT_GE(localiser.counters().odometry_jumps, 1);
    EXPECT_LE(localiser.counters().odometry_jumps, 3);
    EXPECT_LT(median_error(outputs, log.truth, 400), 0.5);
}

TEST(Localiser, MessagesThatComeTwiceAreSkipped) {
    Sent sent;
    sent.frames = 60;
    const Log log = record(sent, 10);
    std::vector<Event> twice;
    for (const Event& e : log.events) {
        twice.push_back(e);
        twice.push_back(e);
    }
    Localiser once(Field{}, {}, random_for);
    Localiser again(Field{}, {}, random_for);
    const auto want = replay(once, log.events);
    const auto got = replay(again, twice);
    ASSERT_EQ(got.size(), want.size());
    expect_same(got.back().estimate, want.back().estimate);
    EXPECT_EQ(again.counters().out_of_order, static_cast<std::int64_t>(log.events.size()));
}

TEST(Localiser, ParticlesGoOutWithEveryNthPose) {
    Sent sent;
    sent.frames = 30;
    const Log log = record(sent, 11);
    LocaliserParameters p;
    p.particles_every = 7;
    Localiser localiser(Field{}, p, random_for);
    const auto outputs = replay(localiser, log.events);
    for (std::size_t i = 0; i < outputs.size(); ++i) EXPECT_EQ(outputs[i].particles.empty(), i % 7 != 0);
    EXPECT_EQ(outputs[7].particles.size(), 400U);
    p.particles_every = 0;
    Localiser silent(Field{}, p, random_for);
    for (const auto& o : replay(silent, log.events)) EXPECT_TRUE(o.particles.empty());
}

TEST(Localiser, SurvivesTimesThatMakeNoSense) {
    Localiser localiser(Field{}, {}, random_for);
    Random random(12);
    int outputs = 0;
    for (int i = 0; i < 3000; ++i) {
        std::int64_t utime = 1'000'000'000 + i * 1000;
        if (random.index(20) == 0) utime = static_cast<std::int64_t>(random.bits());
        switch (random.index(3)) {
            case 0:
                outputs += static_cast<int>(localiser.add(PostsFrame{utime, i, {}, {}}).size());
                break;
            case 1:
                outputs += static_cast<int>(
                    localiser.add(OdometrySample{utime, {random.normal(), 0, 0}, -1, -1, 0}).size());
                break;
            default:
                outputs += static_cast<int>(localiser.add(KinematicsSample{utime, {}}).size());
        }
    }
    EXPECT_GT(outputs, 0);
}

TEST(FrameAligner, OdometryIsInterpolatedAndKinematicsAreTheFramesOwn) {
    FrameAligner aligner({});
    aligner.add(OdometrySample{1'000'000, {0, 0, 3.0}, 0.1, 0.2, 0});
    KinematicsSample k{1'050'000, {}};
    k.camera.T_BC.translation().z() = 0.4;
    aligner.add(k);
    EXPECT_TRUE(aligner.add(PostsFrame{1'050'000, 7, {}, {}}).empty());
    const auto frames = aligner.add(OdometrySample{1'100'000, {1, 2, -3.0}, 0.1, 0.2, 0});
    ASSERT_EQ(frames.size(), 1U);
    ASSERT_TRUE(frames[0].odometry);
    EXPECT_NEAR(frames[0].odometry->pose.x, 0.5, 1e-12);
    EXPECT_NEAR(frames[0].odometry->pose.y, 1.0, 1e-12);
    EXPECT_NEAR(std::abs(frames[0].odometry->pose.theta), 3.14159, 1e-4);
    ASSERT_TRUE(frames[0].camera);
    EXPECT_EQ(frames[0].camera->T_BC.translation().z(), 0.4);
}

TEST(FrameAligner, KinematicsAreInterpolatedBetweenNeighbours) {
    FrameAligner aligner({});
    for (const std::int64_t utime : {1'000'000, 1'100'000}) {
        KinematicsSample k{utime, {}};
        k.camera.T_BC = camera_in_body(0.4, 0, 0, utime == 1'000'000 ? 0.0 : 0.2);
        aligner.add(k);
    }
    aligner.add(OdometrySample{1'050'000, {}, -1, -1, 0});
    const auto frames = aligner.add(PostsFrame{1'050'000, 0, {}, {}});
    ASSERT_EQ(frames.size(), 1U);
    ASSERT_TRUE(frames[0].camera);
    EXPECT_TRUE(frames[0].camera->T_BC.isApprox(camera_in_body(0.4, 0, 0, 0.1), 1e-9));
}

}  // namespace
}  // namespace goalmouth
