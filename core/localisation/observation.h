#pragma once

#include "core/detection/post.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/parameters/parameters.h"

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// One post as the filter uses it: the direction and nearness of its axis, horizontally, from the camera's
/// centre.
struct PostObservation {
    double azimuth = 0.0;  // [rad] in B, from body x, + left
    bool has_distance = false;
    double inverse_distance = 0.0;  // [1/m] of the horizontal distance; 0 without has_distance
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of (azimuth [rad], inverse distance [1/m])
    /// [rad²] of covariance(0, 0): an error of the azimuth that all posts of the frame which have such a part
    /// have alike. 0: none.
    double common_azimuth_variance = 0.0;
    bool refined = false;
    PostSide side = PostSide::unknown;
};

/// What one frame says: `posts` are measured from `camera`, [m] in B.
struct FrameObservation {
    Eigen::Vector2d camera = Eigen::Vector2d::Zero();
    std::vector<PostObservation> posts;
    int unusable =
        0;  // posts that say nothing: fill the image, more than the filter takes, or numbers without sense
};

/// How posts become observations.
struct ObservationParameters {
    std::string distance = "geometry";
    double azimuth_floor = 0.015;
    double distance_floor = 0.03;
    double distance_fraction_floor = 0.05;
    double line_sigma = 0.5;
    double refined_azimuth_floor = 0.004;
    double refined_distance_floor = 0.01;
    double refined_distance_fraction_floor = 0.007;
    double refined_line_sigma = 0.05;
    int most_posts = 4;
    double camera_height = 0.45;
    double camera_pitch = 0.0;
    double camera_angle_sigma = 0.035;
};

template <class Visitor>
void describe_parameters(Visitor& v, ObservationParameters& p) {
    v("distance", p.distance, Choice{"geometry", "message"},
      "geometry: recomputed from the post's width as a cylinder between tangent planes; message: as the "
      "detector says");
    v("azimuth_floor", p.azimuth_floor, Range{0.001, 1}, "rad",
      "σ added to every bearing: what no covariance covers");
    v("distance_floor", p.distance_floor, Range{0, 5}, "m", "σ added to every distance");
    v("distance_fraction_floor", p.distance_fraction_floor, Range{0, 1}, "1",
      "σ added to every distance, as a fraction of it: post diameter, focal length, shading");
    v("line_sigma", p.line_sigma, Range{0.05, 50}, "px", "least σ of a post's middle line across its axis");
    v("refined_azimuth_floor", p.refined_azimuth_floor, Range{0.0001, 1}, "rad",
      "in place of azimuth_floor for refined posts: principal point, rolling shutter, the field's map");
    v("refined_distance_floor", p.refined_distance_floor, Range{0, 5}, "m",
      "in place of distance_floor for refined posts: the field's map");
    v("refined_distance_fraction_floor", p.refined_distance_fraction_floor, Range{0, 1}, "1",
      "in place of distance_fraction_floor for refined posts: post diameter and focal length, 0.5 % each");
    v("refined_line_sigma", p.refined_line_sigma, Range{0.001, 50}, "px",
      "in place of line_sigma for refined posts");
    v("most_posts", p.most_posts, Range{1, 6}, "1", "posts of one frame that are used, widest first");
    v("camera_height", p.camera_height, Range{0.05, 3}, "m", "above the ground, where no kinematics come");
    v("camera_pitch", p.camera_pitch, Range{-1.5, 1.5}, "rad", "looking down, where no kinematics come");
    v("camera_angle_sigma", p.camera_angle_sigma, Range{0, 1}, "rad",
      "σ of roll, pitch and yaw of the camera, where no kinematics come");
}

/// The camera a robot without kinematics is assumed to have: over the body's origin, looking ahead.
CameraPose assumed_camera(const ObservationParameters& parameters);

/// Direction and distance of a post's axis from its image and the camera's pose.
///
/// The middle line of the post, through the middles m_t and m_b of its upper and lower edge ends, has the
/// rays r_t and r_b (in B, by R_BC). They span a plane with normal n = r_t × r_b that holds the camera's
/// centre and the post's axis. A post is vertical, so where R_BC is right n is horizontal and the axis lies
/// along the plane's horizontal trace
///
///     d = ± (−n_y, n_x) / |(n_x, n_y)|      α_plane = atan2(d_y, d_x)
///
/// however the camera is rolled and however much of the post is seen. Dropping n_z is the least rotation that
/// makes the measured vertical lie in the plane. The azimuth of the ray through the line's middle, α_mid, is
/// right only if R_BC is, but does not extrapolate a short line. Both are linearised in the errors
///
///     e = (shift of the line, tilt of the line, width, rotation vector of T_BC)   [px, px, px, rad]
///
/// by central differences, and combined to the estimate of least variance, α = w α_plane + (1 − w) α_mid with
/// 0 ≤ w ≤ 1. The shift's σ is the detector's bearing σ (at least `line_sigma`); a line fitted to evenly
/// spread points with that σ in its middle has √3 times it as its ends' tilt.
///
/// Distance: the rays l and r at half the width left and right of the middle span, with the vertical u'
/// projected onto the plane above, two planes tangent to a cylinder of radius ρ, and 1/D = sin(½∠(l × u', r ×
/// u')) / ρ holds for any tilt and off the optical axis, where the paper's w·γ/w_px does not (FACTS: it falls
/// short by cos² of the angle to the axis). The error of a width is symmetric in 1/D, not in D, which is why
/// the filter compares 1/D.
///
/// The camera's position errors and the floors are added. The camera's yaw error is common to all posts of a
/// frame; it is counted for each of them.
///
/// A refined post (flag `refined`) is taken by its own distance, which is along the ground, and by its own
/// covariance, with the floors for refined posts. For it α is as good as α_plane, which depends on T_BC by
/// the rotation about the vertical alone: that part of its variance is `common_azimuth_variance`. The angle
/// between two refined posts is then as good as the pixels, whatever the camera's yaw.
///
/// Nothing where the post says nothing.
std::optional<PostObservation> observe_post(const Post& post, const Intrinsics& camera,
                                            const CameraPose& pose, double post_diameter,
                                            const ObservationParameters& parameters);

/// All posts of a frame, the widest first.
FrameObservation observe_posts(const std::vector<Post>& posts, const Intrinsics& camera,
                               const CameraPose& pose, double post_diameter,
                               const ObservationParameters& parameters);

}  // namespace goalmouth
