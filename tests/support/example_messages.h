#pragma once

#include "core/messaging/validation.h"

#include <cmath>
#include <cstdint>
#include <vector>

/// One valid, non-trivial message of each type.
namespace goalmouth::test {

inline intrinsics_t example_intrinsics(int width = 8, int height = 4) {
    intrinsics_t m{};
    m.width = width;
    m.height = height;
    m.fx = m.fy = 554.26;
    m.cx = (width - 1) / 2.0;
    m.cy = (height - 1) / 2.0;
    m.distortion[0] = -0.1;
    return m;
}

inline camera_info_t example_camera_info() {
    camera_info_t m{};
    m.utime = 1'000'000;
    m.camera = "front";
    m.source = "simulator";
    m.frames_per_second = 30;
    m.intrinsics = example_intrinsics();
    return m;
}

/// Self-contained, 8×4.
inline image_t example_image() {
    image_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.camera = "front";
    m.intrinsics = example_intrinsics();
    m.width = 8;
    m.height = 4;
    m.row_stride = 16;
    m.encoding = "yuyv";
    m.exposure_us = 8000;
    m.slot = -1;
    m.generation = -1;
    m.size = m.data_size = 64;
    for (int i = 0; i < 64; ++i) m.data.push_back(static_cast<std::uint8_t>(i));
    return m;
}

inline image_t example_descriptor() {
    image_t m = example_image();
    m.ring = "/goalmouth-0-1-front-1";
    m.slot = 2;
    m.generation = 10;
    m.data_size = 0;
    m.data.clear();
    return m;
}

inline image_slice_t example_slice() {
    image_slice_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.camera = "front";
    m.slice = 1;
    m.slices = 3;
    m.offset = 10;
    m.total_size = 25;
    m.data_size = 10;
    m.data.assign(10, 200);
    return m;
}

/// A row of two segments and a column of one, 8×4.
inline segments_t example_segments() {
    segments_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.intrinsics = example_intrinsics();
    m.table = "simulator";
    m.num_lines = 2;
    m.line_orientation = {0, 1};
    m.line_position = {3, 7};
    m.line_count = {2, 1};
    m.num_segments = 3;
    m.start = {0, 5, 0};
    m.end = {4, 7, 3};
    m.colour = {1, 4, 0};
    m.transition_offset = {0, -20, 0};
    return m;
}

inline border_t example_border() {
    border_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.intrinsics = example_intrinsics();
    m.num_hull = 2;
    m.hull_x = {0, 7};
    m.hull_y = {1, 2};
    m.num_points = 3;
    m.point_x = {0, 4, 7};
    m.point_y = {1, 3, 2};
    return m;
}

inline colour_gains_t example_gains() {
    colour_gains_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.from_utime = 1'300'000;
    m.red = 1.1;
    m.green = 0.9;
    m.blue = 0.6;
    m.field[0] = 52.0;
    m.field[1] = 122.0;
    m.field[2] = 62.0;
    m.goal[0] = 226.0;
    m.goal[1] = 184.0;
    m.goal[2] = 34.0;
    return m;
}

inline candidates_t example_candidates() {
    candidates_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.intrinsics = example_intrinsics();
    m.num_segments = 2;
    m.orientation = {0, 1};
    m.line = {3, 7};
    m.start = {2, 0};
    m.end = {5, 3};
    m.num_field = 1;
    m.field_line = {2};
    m.field_start = {6};
    m.field_end = {7};
    m.num_left = 1;
    m.left_x = {1.7F};
    m.left_y = {3.0F};
    m.num_right = 2;
    m.right_x = {5.5F, 5.6F};
    m.right_y = {3.0F, 2.0F};
    return m;
}

inline post_t example_post() {
    post_t m{};
    m.left_top[0] = 2;
    m.left_base[0] = 2;
    m.left_base[1] = 3;
    m.right_top[0] = 5;
    m.right_base[0] = 5;
    m.right_base[1] = 3;
    m.flags = post_t::CUT_TOP;
    m.side = post_t::SIDE_LEFT;
    m.width_px = 3;
    m.distance_m = 2.5;
    m.bearing_rad = -0.2;
    m.covariance[0] = 0.04;
    m.covariance[1] = m.covariance[2] = 0.0005;
    m.covariance[3] = 0.0001;
    m.support_left = 9;
    m.support_right = 8;
    return m;
}

inline posts_t example_posts() {
    posts_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.intrinsics = example_intrinsics();
    m.detector = "detection_ransac";
    m.num_posts = 2;
    m.posts = {example_post(), example_post()};
    m.posts[1].flags = post_t::NO_DISTANCE;
    m.posts[1].distance_m = 0;
    return m;
}

inline distance_cue_t example_cue() {
    distance_cue_t m{};
    m.kind = distance_cue_t::BASE;
    m.distance_m = 2.6;
    m.sigma_m = 0.15;
    return m;
}

/// Both edges measured, the base seen.
inline refined_post_t example_refined_post() {
    refined_post_t m{};
    m.refined = 1;
    m.quality = 0.9;
    m.rows = 40;
    m.rows_left = 38;
    m.rows_right = 40;
    m.iterations = 4;
    m.left_plane[0] = 1;
    m.right_plane[0] = -0.8;
    m.right_plane[2] = 0.6;
    m.base_seen = 1;
    m.base[0] = 3.5;
    m.base[1] = 3;
    m.num_cues = 2;
    m.cues = {example_cue(), example_cue()};
    m.cues[0].kind = distance_cue_t::WIDTH;
    return m;
}

/// The second post was not measured.
inline refinement_t example_refinement() {
    refinement_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.num_posts = 2;
    m.posts = {example_refined_post(), refined_post_t{}};
    m.posts[1].reason = "no picture";
    return m;
}

inline odometry_t example_odometry() {
    odometry_t m{};
    m.utime = 1'000'000;
    m.seq = 3;
    m.x = 0.5;
    m.theta = 12.0;
    m.translation_noise = 0.2;
    m.rotation_noise = -1;
    return m;
}

inline kinematics_t example_kinematics() {
    kinematics_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.translation[2] = 0.4;
    m.quaternion[0] = std::sqrt(0.5);
    m.quaternion[1] = -std::sqrt(0.5);
    for (int i = 0; i < 6; ++i) m.covariance[7 * i] = 1e-4;
    return m;
}

inline pose_hypothesis_t example_hypothesis() {
    pose_hypothesis_t m{};
    m.weight = 0.6;
    m.x = -1;
    m.theta = 3.1;
    m.covariance[0] = m.covariance[4] = 0.01;
    m.covariance[8] = 0.02;
    return m;
}

inline pose_t example_pose() {
    pose_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.x = -1;
    m.theta = 3.1;
    m.covariance[0] = m.covariance[4] = 0.01;
    m.covariance[8] = 0.02;
    m.effective_sample_size = 120;
    m.posts_used = 2;
    m.num_hypotheses = 2;
    m.hypotheses = {example_hypothesis(), example_hypothesis()};
    m.hypotheses[1].weight = 0.3;
    return m;
}

inline particles_t example_particles() {
    particles_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.num_particles = 2;
    m.x = {1, 2};
    m.y = {0, 0};
    m.theta = {0, 1};
    m.weight = {0.25F, 0.75F};
    return m;
}

inline truth_t example_truth() {
    truth_t m{};
    m.utime = 1'000'000;
    m.seq = 7;
    m.x = 1;
    m.camera_translation[2] = 0.4;
    m.camera_quaternion[0] = 1;
    m.num_posts = 1;
    m.posts.resize(1);
    m.posts[0] = truth_post_t{};
    m.posts[0].id = 2;
    m.posts[0].x = 3;
    m.posts[0].distance_m = 2;
    m.posts[0].visible = 1;
    return m;
}

inline status_t example_status() {
    status_t m{};
    m.utime = 1'000'000;
    m.process = "segmentation";
    m.executable = "segmentation";
    m.pid = 4711;
    m.state = status_t::RUNNING;
    m.received = 30;
    m.published = 30;
    m.rate = 30;
    m.latency_p50 = 0.004;
    m.latency_p99 = -1;
    m.busy = 0.1;
    m.num_counters = 1;
    m.counters.resize(1);
    m.counters[0].name = "frame_gone";
    m.counters[0].value = 2;
    return m;
}

/// Calls `f(message)` with one valid message of each type that travels alone.
template <class F>
void for_each_example(F f) {
    f(example_camera_info());
    f(example_image());
    f(example_descriptor());
    f(example_slice());
    f(example_segments());
    f(example_border());
    f(example_candidates());
    f(example_gains());
    f(example_posts());
    f(example_refinement());
    f(example_odometry());
    f(example_kinematics());
    f(example_pose());
    f(example_particles());
    f(example_truth());
    f(example_status());
    f(example_intrinsics());
    f(example_post());
    f(example_cue());
    f(example_refined_post());
    f(example_hypothesis());
}

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
}

}  // namespace goalmouth::test
