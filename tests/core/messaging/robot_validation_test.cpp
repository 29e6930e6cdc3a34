#include "core/messaging/validation.h"
#include "tests/core/messaging/breakages.h"
#include "tests/support/example_messages.h"

#include <string>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

TEST(Validation, OdometryIsFinite) {
    using M = odometry_t;
    expect_each_refused<M>(example_odometry(), {
                                                   [](M& m) { m.utime = -1; },
                                                   [](M& m) { m.seq = -1; },
                                                   [](M& m) { m.x = nan; },
                                                   [](M& m) { m.y = infinity; },
                                                   [](M& m) { m.theta = nan; },
                                                   [](M& m) { m.translation_noise = -0.5; },
                                                   [](M& m) { m.rotation_noise = nan; },
                                               });
}

TEST(Validation, KinematicsIsARotationWithACovariance) {
    using M = kinematics_t;
    expect_each_refused<M>(example_kinematics(), {
                                                     [](M& m) { m.utime = -1; },
                                                     [](M& m) { m.seq = -2; },
                                                     [](M& m) { m.translation[1] = nan; },
                                                     [](M& m) { m.quaternion[0] = 0; },
                                                     [](M& m) { m.quaternion[3] = nan; },
                                                     [](M& m) { m.covariance[0] = -1; },
                                                     [](M& m) { m.covariance[1] = 1e-5; },
                                                     [](M& m) { m.covariance[35] = nan; },
                                                 });
    auto of_no_frame = example_kinematics();
    of_no_frame.seq = -1;
    EXPECT_EQ(problem(of_no_frame), std::nullopt);
}

TEST(Validation, PosesKeepTheirRanges) {
    using M = pose_t;
    expect_each_refused<M>(example_pose(), {
                                               [](M& m) { m.utime = -1; },
                                               [](M& m) { m.seq = -2; },
                                               [](M& m) { m.x = nan; },
                                               [](M& m) { m.y = nan; },
                                               [](M& m) { m.theta = 3.2; },
                                               [](M& m) { m.theta = nan; },
                                               [](M& m) { m.covariance[4] = -1; },
                                               [](M& m) { m.effective_sample_size = 0.5; },
                                               [](M& m) { m.effective_sample_size = nan; },
                                               [](M& m) { m.posts_used = -1; },
                                               [](M& m) { m.posts_rejected = -1; },
                                               [](M& m) { m.num_hypotheses = 1; },
                                               [](M& m) { m.num_hypotheses = 0, m.hypotheses.clear(); },
                                               [](M& m) { m.hypotheses[0].weight = 1.5; },
                                               [](M& m) { m.hypotheses[1].weight = 0.7; },
                                               [](M& m) { m.hypotheses[0].weight = 0.8; },
                                               [](M& m) { m.hypotheses[1].weight = -0.1; },
                                               [](M& m) { m.hypotheses[1].weight = nan; },
                                               [](M& m) { m.hypotheses[1].x = nan; },
                                               [](M& m) { m.hypotheses[1].theta = -4; },
                                               [](M& m) { m.hypotheses[1].covariance[8] = nan; },
                                           });
}

TEST(Validation, ParticlesWeighOne) {
    using M = particles_t;
    expect_each_refused<M>(example_particles(), {
                                                    [](M& m) { m.utime = -1; },
                                                    [](M& m) { m.seq = -2; },
                                                    [](M& m) { m.num_particles = 3; },
                                                    [](M& m) { m.y.pop_back(); },
                                                    [](M& m) { m.theta.pop_back(); },
                                                    [](M& m) { m.weight.pop_back(); },
                                                    [](M& m) { m.x[0] = nan_f; },
                                                    [](M& m) { m.y[0] = nan_f; },
                                                    [](M& m) { m.theta[0] = nan_f; },
                                                    [](M& m) { m.weight[0] = nan_f; },
                                                    [](M& m) {
                                                        m.weight = {-0.25F, 1.25F};
                                                    },
                                                    [](M& m) { m.weight[0] = 0.5F; },
                                                });
}

TEST(Validation, TruthMakesSense) {
    using M = truth_t;
    expect_each_refused<M>(example_truth(), {
                                                [](M& m) { m.utime = -1; },
                                                [](M& m) { m.seq = -1; },
                                                [](M& m) { m.x = nan; },
                                                [](M& m) { m.y = nan; },
                                                [](M& m) { m.theta = nan; },
                                                [](M& m) { m.camera_translation[0] = nan; },
                                                [](M& m) { m.camera_quaternion[0] = 2; },
                                                [](M& m) { m.ball_x = nan; },
                                                [](M& m) { m.ball_y = nan; },
                                                [](M& m) { m.num_posts = 0; },
                                                [](M& m) { m.posts[0].id = 4; },
                                                [](M& m) { m.posts[0].id = -1; },
                                                [](M& m) { m.posts[0].x = nan; },
                                                [](M& m) { m.posts[0].y = nan; },
                                                [](M& m) { m.posts[0].distance_m = -1; },
                                                [](M& m) { m.posts[0].bearing_rad = 4; },
                                                [](M& m) { m.posts[0].left_top[0] = nan; },
                                                [](M& m) { m.posts[0].left_base[0] = nan; },
                                                [](M& m) { m.posts[0].right_top[0] = nan; },
                                                [](M& m) { m.posts[0].right_base[0] = nan; },
                                                [](M& m) { m.posts[0].visible = 1.1; },
                                                [](M& m) { m.posts[0].visible = nan; },
                                            });
}

TEST(Validation, StatusMakesSense) {
    using M = status_t;
    expect_each_refused<M>(example_status(), {
                                                 [](M& m) { m.utime = -1; },
                                                 [](M& m) { m.process = std::string("\0", 1); },
                                                 [](M& m) { m.executable = std::string("\0", 1); },
                                                 [](M& m) { m.pid = -1; },
                                                 [](M& m) { m.state = 3; },
                                                 [](M& m) { m.state = -1; },
                                                 [](M& m) { m.received = -1; },
                                                 [](M& m) { m.published = -1; },
                                                 [](M& m) { m.dropped = -1; },
                                                 [](M& m) { m.rejected = -1; },
                                                 [](M& m) { m.rate = nan; },
                                                 [](M& m) { m.rate = -1; },
                                                 [](M& m) { m.latency_p50 = -0.5; },
                                                 [](M& m) { m.latency_p99 = nan; },
                                                 [](M& m) { m.busy = -1; },
                                                 [](M& m) { m.num_counters = 2; },
                                                 [](M& m) { m.counters[0].name = std::string("\0", 1); },
                                                 [](M& m) { m.counters[0].value = infinity; },
                                             });
}

}  // namespace
}  // namespace goalmouth
