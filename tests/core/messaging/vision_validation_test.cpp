#include "core/messaging/validation.h"
#include "tests/core/messaging/breakages.h"
#include "tests/support/example_messages.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

TEST(Validation, GainsAreFactors) {
    using M = colour_gains_t;
    expect_each_refused<M>(example_gains(), {
                                                [](M& m) { m.utime = -1; },
                                                [](M& m) { m.seq = -1; },
                                                [](M& m) { m.from_utime = m.utime - 1; },
                                                [](M& m) { m.from_utime = m.utime + 60'000'001; },
                                                [](M& m) { m.red = 0.0; },
                                                [](M& m) { m.green = 21.0; },
                                                [](M& m) { m.blue = std::nan(""); },
                                                [](M& m) { m.field[0] = -1.0; },
                                                [](M& m) { m.goal[2] = 256.0; },
                                                [](M& m) { m.goal[1] = std::nan(""); },
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
                               [](M& m) { m.num_field = 2; },       [](M& m) { m.field_end.clear(); },
                               [](M& m) { m.field_line[0] = 4; },   [](M& m) { m.field_line[0] = -1; },
                               [](M& m) { m.field_start[0] = 8; },  [](M& m) { m.field_start[0] = -1; },
                               [](M& m) { m.field_end[0] = 8; },    [](M& m) { m.field_end[0] = 5; },
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

}  // namespace
}  // namespace goalmouth
