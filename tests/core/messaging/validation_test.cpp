#include "core/messaging/validation.h"

#include "tests/support/example_messages.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Each breakage of a valid message must be found, and none may be missed because another one hides it.
template <class Message>
void expect_each_refused(const Message& valid, const std::vector<std::function<void(Message&)>>& breakages) {
    ASSERT_EQ(problem(valid), std::nullopt);
    for (std::size_t i = 0; i < breakages.size(); ++i) {
        Message broken = valid;
        breakages[i](broken);
        EXPECT_TRUE(problem(broken).has_value()) << Message::getTypeName() << ", breakage " << i;
    }
}

TEST(Validation, AcceptsAnExampleOfEachType) {
    for_each_example(
        [](const auto& message) { EXPECT_EQ(problem(message), std::nullopt) << message.getTypeName(); });
}

TEST(Validation, AcceptsEmptyAnswers) {
    auto border = example_border();
    border.num_hull = border.num_points = 0;
    border.hull_x.clear(), border.hull_y.clear(), border.point_x.clear(), border.point_y.clear();
    EXPECT_EQ(problem(border), std::nullopt);
    auto posts = example_posts();
    posts.num_posts = 0;
    posts.posts.clear();
    EXPECT_EQ(problem(posts), std::nullopt);
    auto candidates = candidates_t{};
    candidates.intrinsics = example_intrinsics();
    EXPECT_EQ(problem(candidates), std::nullopt);
    auto segments = segments_t{};
    segments.intrinsics = example_intrinsics();
    EXPECT_EQ(problem(segments), std::nullopt);
}

TEST(Validation, IntrinsicsKeepTheirRanges) {
    using M = intrinsics_t;
    expect_each_refused<M>(example_intrinsics(), {
                                                     [](M& m) { m.width = 0; },
                                                     [](M& m) { m.width = 16385; },
                                                     [](M& m) { m.height = -1; },
                                                     [](M& m) { m.height = 16385; },
                                                     [](M& m) { m.fx = 0; },
                                                     [](M& m) { m.fy = -1; },
                                                     [](M& m) { m.fx = nan; },
                                                     [](M& m) { m.cx = infinity; },
                                                     [](M& m) { m.cy = nan; },
                                                     [](M& m) { m.distortion[4] = nan; },
                                                 });
    auto largest = example_intrinsics(16384, 16384);
    EXPECT_EQ(problem(largest), std::nullopt);
}

TEST(Validation, CameraInfoKeepsItsRanges) {
    using M = camera_info_t;
    expect_each_refused<M>(example_camera_info(), {
                                                      [](M& m) { m.utime = -1; },
                                                      [](M& m) { m.camera = std::string("a\0b", 3); },
                                                      [](M& m) { m.source = std::string("\0", 1); },
                                                      [](M& m) { m.frames_per_second = -1; },
                                                      [](M& m) { m.frames_per_second = nan; },
                                                      [](M& m) { m.intrinsics.fx = 0; },
                                                  });
}

TEST(Validation, SelfContainedImagesHoldTheirPixels) {
    using M = image_t;
    expect_each_refused<M>(example_image(), {
                                                [](M& m) { m.utime = -1; },
                                                [](M& m) { m.seq = -1; },
                                                [](M& m) { m.width = 9; },
                                                [](M& m) { m.height = 3; },
                                                [](M& m) { m.intrinsics.width = 7; },
                                                [](M& m) { m.camera = std::string("a\0", 2); },
                                                [](M& m) { m.row_stride = 15; },
                                                [](M& m) { m.row_stride = 17; },
                                                [](M& m) { m.row_stride = std::numeric_limits<int>::max(); },
                                                [](M& m) { m.encoding = "rgb"; },
                                                [](M& m) { m.encoding = "jpeg"; },
                                                [](M& m) { m.exposure_us = -1; },
                                                [](M& m) { m.readout_us = -1; },
                                                [](M& m) { m.slot = 0; },
                                                [](M& m) { m.generation = 0; },
                                                [](M& m) { m.ring = "/goalmouth-0-1-a-1"; },
                                                [](M& m) { m.size = 63; },
                                                [](M& m) { m.data_size = 63; },
                                                [](M& m) { m.data_size = -1; },
                                                [](M& m) { m.data.pop_back(); },
                                                [](M& m) { m.data_size = m.size = 0, m.data.clear(); },
                                            });
    auto jpeg = example_image();
    jpeg.encoding = "jpeg";
    jpeg.row_stride = 0;
    EXPECT_EQ(problem(jpeg), std::nullopt);
    jpeg.size = jpeg.data_size = 0;
    jpeg.data.clear();
    EXPECT_TRUE(problem(jpeg).has_value());
}

TEST(Validation, AnImageOfOddWidthHoldsOnePixelMore) {
    auto image = example_image();
    image.width = image.intrinsics.width = 7;
    EXPECT_EQ(problem(image), std::nullopt);
    image.width = image.intrinsics.width = 9;
    EXPECT_TRUE(problem(image).has_value());
}

TEST(Validation, DescriptorsNameASlotAndCarryNoPixels) {
    using M = image_t;
    expect_each_refused<M>(example_descriptor(), {
                                                     [](M& m) { m.ring = ""; },
                                                     [](M& m) { m.slot = -1; },
                                                     [](M& m) { m.generation = -1; },
                                                     [](M& m) { m.data_size = 1, m.data = {1}; },
                                                     [](M& m) { m.data_size = 1; },
                                                     [](M& m) { m.size = 0; },
                                                     [](M& m) { m.size = std::numeric_limits<int>::max(); },
                                                 });
}

TEST(Validation, SlicesLieInsideTheirImage) {
    using M = image_slice_t;
    constexpr int largest = std::numeric_limits<int>::max();
    expect_each_refused<M>(example_slice(), {
                                                [](M& m) { m.utime = -1; },
                                                [](M& m) { m.seq = -1; },
                                                [](M& m) { m.camera = std::string("\0", 1); },
                                                [](M& m) { m.slices = 0; },
                                                [](M& m) { m.slice = -1; },
                                                [](M& m) { m.slice = 3; },
                                                [](M& m) { m.slices = 26; },
                                                [](M& m) { m.offset = -1; },
                                                [](M& m) { m.offset = 16; },
                                                [](M& m) { m.offset = largest; },
                                                [](M& m) { m.offset = 0; },
                                                [](M& m) { m.offset = 15; },
                                                [](M& m) { m.slice = 0; },
                                                [](M& m) { m.slice = 2; },
                                                [](M& m) { m.total_size = 0; },
                                                [](M& m) { m.total_size = 9; },
                                                [](M& m) { m.data_size = 9; },
                                                [](M& m) { m.data_size = 0, m.data.clear(); },
                                                [](M& m) { m.data_size = -1; },
                                            });
}

TEST(Validation, SegmentsCoverTheirLines) {
    using M = segments_t;
    expect_each_refused<M>(example_segments(),
                           {
                               [](M& m) { m.utime = -1; },
                               [](M& m) { m.seq = -1; },
                               [](M& m) { m.intrinsics.height = 0; },
                               [](M& m) { m.table = std::string("\0", 1); },
                               [](M& m) { m.lines_left_out = -1; },
                               [](M& m) { m.num_lines = 1; },
                               [](M& m) { m.num_lines = -1; },
                               [](M& m) { m.line_position.pop_back(); },
                               [](M& m) { m.line_count.push_back(0); },
                               [](M& m) { m.line_orientation[0] = 2; },
                               [](M& m) { m.line_orientation[0] = -1; },
                               [](M& m) { m.line_orientation[0] = 1; },  // 3 is a column, but not 8 px long
                               [](M& m) { m.line_position[0] = 4; },
                               [](M& m) { m.line_position[1] = 8; },
                               [](M& m) { m.line_position[1] = -1; },
                               [](M& m) {
                                   m.line_count = {1, 1};
                               },
                               [](M& m) {
                                   m.line_count = {2, 2};
                               },
                               [](M& m) {
                                   m.line_count = {3, 0};
                               },
                               [](M& m) {
                                   m.line_count = {-1, 4};
                               },
                               [](M& m) {
                                   m.line_count = {32767, 32767};
                               },
                               [](M& m) { m.num_segments = 2; },
                               [](M& m) { m.start.pop_back(); },
                               [](M& m) { m.end.pop_back(); },
                               [](M& m) { m.colour.pop_back(); },
                               [](M& m) { m.transition_offset.pop_back(); },
                               [](M& m) { m.start[0] = 1; },
                               [](M& m) { m.start[1] = 4; },
                               [](M& m) { m.start[1] = 6; },
                               [](M& m) { m.end[0] = -1, m.start[1] = 0; },
                               [](M& m) { m.end[1] = 8; },
                               [](M& m) { m.end[1] = 6; },
                               [](M& m) { m.end[2] = 4; },
                               [](M& m) { m.colour[0] = 6; },
                               [](M& m) { m.colour[0] = -1; },
                           });
}

TEST(Validation, BorderPointsLieInTheImage) {
    using M = border_t;
    expect_each_refused<M>(example_border(), {
                                                 [](M& m) { m.utime = -1; },
                                                 [](M& m) { m.seq = -1; },
                                                 [](M& m) { m.intrinsics.fy = 0; },
                                                 [](M& m) { m.num_hull = 3; },
                                                 [](M& m) { m.num_hull = -2; },
                                                 [](M& m) { m.hull_y.pop_back(); },
                                                 [](M& m) { m.num_points = 2; },
                                                 [](M& m) { m.point_y.pop_back(); },
                                                 [](M& m) { m.hull_x[0] = nan_f; },
                                                 [](M& m) { m.hull_y[0] = nan_f; },
                                                 [](M& m) { m.hull_x[1] = 20; },
                                                 [](M& m) { m.hull_y[1] = -20; },
                                                 [](M& m) {
                                                     m.hull_x = {7, 0};
                                                 },
                                                 [](M& m) { m.point_x[0] = -20; },
                                                 [](M& m) { m.point_y[0] = 1e30F; },
                                             });
}

TEST(Validation, CandidatesLieInTheImage) {
    using M = candidates_t;
    expect_each_refused<M>(example_candidates(),
                           {
                               [](M& m) { m.utime = -1; },          [](M& m) { m.seq = -1; },
                               [](M& m) { m.intrinsics.cx = nan; }, [](M& m) { m.num_segments = 1; },
                               [](M& m) { m.line.pop_back(); },     [](M& m) { m.start.pop_back(); },
                               [](M& m) { m.end.pop_back(); },      [](M& m) { m.orientation[0] = 3; },
                               [](M& m) { m.line[0] = 4; },         [](M& m) { m.line[0] = -1; },
                               [](M& m) { m.start[0] = 6; },        [](M& m) { m.start[0] = -1; },
                               [](M& m) { m.end[0] = 8; },          [](M& m) { m.end[1] = 4; },
                               [](M& m) { m.num_left = 2; },        [](M& m) { m.left_y.clear(); },
                               [](M& m) { m.left_x[0] = nan_f; },   [](M& m) { m.left_y[0] = 99; },
                               [](M& m) { m.num_right = -1; },      [](M& m) { m.right_x.clear(); },
                               [](M& m) { m.right_y[1] = nan_f; },
                           });
}

TEST(Validation, PostsMakeSense) {
    using M = post_t;
    expect_each_refused<M>(example_post(), {
                                               [](M& m) { m.left_top[0] = nan; },
                                               [](M& m) { m.left_base[1] = infinity; },
                                               [](M& m) { m.right_top[1] = nan; },
                                               [](M& m) { m.right_base[0] = nan; },
                                               [](M& m) { m.flags = 512; },
                                               [](M& m) { m.flags = -1; },
                                               [](M& m) { m.side = 3; },
                                               [](M& m) { m.side = -1; },
                                               [](M& m) { m.width_px = 0; },
                                               [](M& m) { m.width_px = nan; },
                                               [](M& m) { m.distance_m = 0; },
                                               [](M& m) { m.distance_m = infinity; },
                                               [](M& m) { m.flags = post_t::NO_DISTANCE; },
                                               [](M& m) { m.bearing_rad = 1.6; },
                                               [](M& m) { m.bearing_rad = nan; },
                                               [](M& m) { m.covariance[0] = -1e-3; },
                                               [](M& m) { m.covariance[3] = nan; },
                                               [](M& m) { m.covariance[1] = 0.1; },
                                               [](M& m) { m.covariance[1] = m.covariance[2] = 0.1; },
                                               [](M& m) { m.support_left = -1; },
                                               [](M& m) { m.support_right = -1; },
                                           });
    using L = posts_t;
    expect_each_refused<L>(example_posts(), {
                                                [](L& m) { m.utime = -1; },
                                                [](L& m) { m.seq = -1; },
                                                [](L& m) { m.intrinsics.fx = 0; },
                                                [](L& m) { m.detector = std::string("\0", 1); },
                                                [](L& m) { m.num_posts = 3; },
                                                [](L& m) { m.num_posts = -1; },
                                                [](L& m) { m.posts[1].width_px = nan; },
                                            });
}

TEST(Validation, RefinementsMakeSense) {
    using C = distance_cue_t;
    expect_each_refused<C>(example_cue(), {
                                              [](C& m) { m.kind = 4; },
                                              [](C& m) { m.kind = -1; },
                                              [](C& m) { m.distance_m = 0; },
                                              [](C& m) { m.distance_m = nan; },
                                              [](C& m) { m.sigma_m = -0.1; },
                                              [](C& m) { m.sigma_m = infinity; },
                                          });
    using M = refined_post_t;
    expect_each_refused<M>(example_refined_post(), {
                                                       [](M& m) { m.refined = 2; },
                                                       [](M& m) { m.reason = "blurred"; },
                                                       [](M& m) { m.reason = std::string("\0", 1); },
                                                       [](M& m) { m.quality = -0.1; },
                                                       [](M& m) { m.quality = 1.1; },
                                                       [](M& m) { m.quality = nan; },
                                                       [](M& m) { m.rows = -1; },
                                                       [](M& m) { m.iterations = -1; },
                                                       [](M& m) { m.rows_left = -1; },
                                                       [](M& m) { m.rows_right = 41; },
                                                       [](M& m) { m.left_plane[0] = 0.5; },
                                                       [](M& m) { m.left_plane[1] = nan; },
                                                       [](M& m) { m.left_plane[0] = 0; },
                                                       [](M& m) { m.right_plane[2] = infinity; },
                                                       [](M& m) {
                                                           for (double& v : m.left_plane) v = 0;
                                                           for (double& v : m.right_plane) v = 0;
                                                           m.rows_left = m.rows_right = 0;
                                                       },
                                                       [](M& m) { m.base_seen = -1; },
                                                       [](M& m) { m.base[0] = nan; },
                                                       [](M& m) { m.top_seen = 3; },
                                                       [](M& m) { m.top[1] = infinity; },
                                                       [](M& m) { m.num_cues = 3; },
                                                       [](M& m) { m.num_cues = -1; },
                                                       [](M& m) { m.cues[1].kind = 9; },
                                                   });
    using L = refinement_t;
    expect_each_refused<L>(example_refinement(), {
                                                     [](L& m) { m.utime = -1; },
                                                     [](L& m) { m.seq = -1; },
                                                     [](L& m) { m.num_posts = 1; },
                                                     [](L& m) { m.posts[1].quality = nan; },
                                                 });
    EXPECT_EQ(problem(refined_post_t{}), std::nullopt);
}

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
