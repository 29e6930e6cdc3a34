#pragma once

#include "core/parameters/parameters.h"

#include <array>
#include <string>

namespace goalmouth {

/// How the robot stands before the goal in an evaluation (the paper's section 5): uniform draws about the
/// cell's distance and tilt.
struct ViewParameters {
    double camera_height = 0.42;
    double yaw = 0.1745;
    double pitch_lowest = 0.0;
    double pitch_highest = 0.1047;
};

template <class Visitor>
void describe_parameters(Visitor& v, ViewParameters& p) {
    v("camera_height", p.camera_height, Range{0.05, 3}, "m", "of the camera above the ground");
    v("yaw", p.yaw, Range{0, 1.5}, "rad", "the camera looks past the post by up to this to either side");
    v("pitch_lowest", p.pitch_lowest, Range{-1.5, 1.5}, "rad",
      "least angle of the optical axis below the horizon");
    v("pitch_highest", p.pitch_highest, Range{-1.5, 1.5}, "rad",
      "largest angle of the optical axis below the horizon");
}

/// How fast the camera moves while a frame is taken: σ of normal draws for each frame.
struct CameraMotionParameters {
    double speed = 0.0;
    double roll_rate = 0.0;
    double pitch_rate = 0.0;
    double yaw_rate = 0.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, CameraMotionParameters& p) {
    v("speed", p.speed, Range{0, 5}, "m/s", "σ of the camera's speed along each level axis");
    v("roll_rate", p.roll_rate, Range{0, 20}, "rad/s", "σ of the turn about the optical axis");
    v("pitch_rate", p.pitch_rate, Range{0, 20}, "rad/s", "σ of the turn about the image's x axis");
    v("yaw_rate", p.yaw_rate, Range{0, 20}, "rad/s", "σ of the turn about the image's y axis");
}

/// What the camera is, against what its calibration file says (the file given for the evaluation).
struct LensParameters {
    double k1 = 0.0;
    double k2 = 0.0;
    double p1 = 0.0;
    double p2 = 0.0;
    bool distortion_known = true;
    double focal_error = 0.0;
    double centre_error = 0.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, LensParameters& p) {
    v("k1", p.k1, Range{-10, 10}, "1", "true radial distortion, r^2, in place of the calibration file's");
    v("k2", p.k2, Range{-10, 10}, "1", "true radial distortion, r^4");
    v("p1", p.p1, Range{-1, 1}, "1", "true tangential distortion");
    v("p2", p.p2, Range{-1, 1}, "1", "true tangential distortion");
    v("distortion_known", p.distortion_known,
      "the detectors are told the true distortion; false: that there is none");
    v("focal_error", p.focal_error, Range{0, 0.5}, "1",
      "σ of the relative error of the focal length the detectors are told, drawn for each frame");
    v("centre_error", p.centre_error, Range{0, 100}, "px",
      "σ of the error of the principal point they are told, in x and in y");
}

/// Other robots between camera and goal, on purpose.
struct OccluderParameters {
    double share = 0.0;
    double largest_hidden = 0.4;
};

template <class Visitor>
void describe_parameters(Visitor& v, OccluderParameters& p) {
    v("share", p.share, Range{0, 1}, "1",
      "share of the frames with a robot or a fallen robot between the camera and the post in line");
    v("largest_hidden", p.largest_hidden, Range{0, 1}, "1",
      "a post of which more is hidden, of what lies inside the picture, does not count");
}

/// What the robot's joints and gyroscopes tell of the camera's place over its feet, for detectors that use
/// it.
struct MeasuredPoseParameters {
    bool told = true;
    double attitude_sigma = 0.01745;
    double height_sigma = 0.01;
};

template <class Visitor>
void describe_parameters(Visitor& v, MeasuredPoseParameters& p) {
    v("told", p.told, "the detectors are told the camera's attitude and height; false: nothing of it");
    v("attitude_sigma", p.attitude_sigma, Range{0, 1}, "rad",
      "σ of the attitude's error about each axis, drawn for each frame");
    v("height_sigma", p.height_sigma, Range{0, 1}, "m", "σ of the height's error, drawn for each frame");
}

/// What the files of config/evaluation hold: a scene of config/scenes and how it is looked at.
struct EvaluationSceneParameters {
    std::string scene;
    ViewParameters view;
    CameraMotionParameters motion;
    LensParameters lens;
    OccluderParameters occluders;
    MeasuredPoseParameters kinematics;
    double least_inside = 0.5;
};

template <class Visitor>
void describe_parameters(Visitor& v, EvaluationSceneParameters& p) {
    v("scene", p.scene, File{.may_be_empty = true}, "hall, light and camera: a file of config/scenes");
    v("least_inside", p.least_inside, Range{0, 1}, "1",
      "a post counts if in at least this share of its rows in the picture both its edges lie between the "
      "picture's left and right border");
    v.group("view", p.view, "how the robot stands before the goal");
    v.group("motion", p.motion, "how the camera moves while a frame is taken");
    v.group("lens", p.lens, "what the camera is, against what the detectors are told");
    v.group("occluders", p.occluders, "robots between the camera and the goal");
    v.group("kinematics", p.kinematics, "what the detectors are told of the camera's attitude and height");
}

}  // namespace goalmouth
