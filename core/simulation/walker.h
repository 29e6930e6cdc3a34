#pragma once

#include "core/field/field.h"
#include "core/geometry/pose2.h"
#include "core/parameters/parameters.h"
#include "core/random/random.h"
#include "core/simulation/camera_motion.h"
#include "core/simulation/odometry_model.h"
#include "core/simulation/route.h"

#include <array>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// How the body moves over the ground it walks on.
struct GaitParameters {
    double speed = 0.2;
    double acceleration = 0.2;
    double frequency = 1.75;
    double roll = 0.06;
    double pitch = 0.02;
    double sway = 0.008;
    double bob = 0.004;
    double camera_height = 0.42;
    double camera_forward = 0.03;
};

template <class Visitor>
void describe_parameters(Visitor& v, GaitParameters& p) {
    v("speed", p.speed, Range{0, 2}, "m/s", "along the route; 0: stands at its start");
    v("acceleration", p.acceleration, Range{0.001, 100}, "m/s²", "until that speed is reached");
    v("frequency", p.frequency, Range{0.1, 10}, "Hz",
      "of the gait, two footsteps each; the body stands still at speed 0");
    v("roll", p.roll, Range{0, 0.5}, "rad", "largest lean to either side, once a gait cycle");
    v("pitch", p.pitch, Range{0, 0.5}, "rad", "largest nod, once a footstep");
    v("sway", p.sway, Range{0, 0.2}, "m", "sideways beside what the lean does, once a gait cycle");
    v("bob", p.bob, Range{0, 0.1}, "m", "up and down, once a footstep");
    v("camera_height", p.camera_height, Range{0.05, 3}, "m", "of the camera above the ground, upright");
    v("camera_forward", p.camera_forward, Range{-0.5, 0.5}, "m", "of the camera before the body's centre");
}

/// Where the head looks: at the nearest goal the neck can turn to, sweeping about it; straight ahead,
/// sweeping wide, where there is none.
struct HeadParameters {
    double pan_limit = 1.4;
    double sweep = 0.3;
    double search_sweep = 0.8;
    double sweep_period = 4.0;
    double tilt = 0.17;
    double tilt_sweep = 0.09;
    double tilt_period = 5.3;
    double speed = 2.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, HeadParameters& p) {
    v("pan_limit", p.pan_limit, Range{0, 3.2}, "rad", "how far the neck turns to either side");
    v("sweep", p.sweep, Range{0, 3.2}, "rad", "to either side of the goal looked at");
    v("search_sweep", p.search_sweep, Range{0, 3.2}, "rad", "to either side where no goal can be looked at");
    v("sweep_period", p.sweep_period, Range{0.1, 1000}, "s", "of the sweep from side to side");
    v("tilt", p.tilt, Range{-1.5, 1.5}, "rad", "of the head below the horizon");
    v("tilt_sweep", p.tilt_sweep, Range{0, 1.5}, "rad", "up and down about that");
    v("tilt_period", p.tilt_period, Range{0.1, 1000}, "s", "of the sweep up and down");
    v("speed", p.speed, Range{0.01, 100}, "rad/s", "fastest turn of either head joint");
}

struct WalkParameters {
    GaitParameters gait;
    HeadParameters head;
    OdometryParameters odometry;
};

template <class Visitor>
void describe_parameters(Visitor& v, WalkParameters& p) {
    v.group("gait", p.gait, "how the body moves");
    v.group("head", p.head, "where the head looks");
    v.group("odometry", p.odometry, "how badly the robot counts its own steps");
}

/// A robot that walks a route, looks at goals and counts its steps. Everything is a function of the
/// parameters, the run's random numbers and the time walked: the body moves in ticks of its own, however
/// often it is asked.
class Walker {
  public:
    Walker(const WalkParameters& parameters, const Field& field, Route route, Random run);

    /// Walks on until `time` [s] since the start; time never runs backwards.
    void advance(double time);

    double time() const { return time_; }
    /// Body frame B in W: on the ground under the torso, x along the heading.
    Pose2 pose() const { return pose_at(time_); }
    Eigen::Isometry3d T_BC() const { return T_BC_at(time_); }
    Eigen::Isometry3d T_WC() const { return T_WC_at(time_); }
    /// Velocity and turn rate of the camera now, as the head's joints move since their last tick.
    CameraMotion motion() const;
    /// As the robot counted it, in a frame that starts at its first pose.
    Pose2 odometry() const;

  private:
    double distance_at(double time) const;
    Pose2 pose_at(double time) const { return route_.at(distance_at(time)); }
    Eigen::Isometry3d T_BC_at(double time) const;  // the head's joints as they move since the last tick
    Eigen::Isometry3d T_WC_at(double time) const;
    std::int64_t footstep_at(double time) const;
    double look_at_goal(const Pose2& pose, double time);

    WalkParameters parameters_;
    std::array<Eigen::Vector2d, 2> goals_;
    Route route_;
    OdometryModel odometry_;
    std::int64_t tick_ = 0;
    double time_ = 0.0;
    double pan_ = 0.0, tilt_ = 0.0;            // rad, at the last tick: + left, + down
    double pan_rate_ = 0.0, tilt_rate_ = 0.0;  // rad/s, until the next
    int goal_ = -1;                            // looked at: index, −1 none
};

/// What joint angles and inertial sensors make of the camera's pose in the body: off by one bias a run and
/// noise each frame.
struct KinematicsParameters {
    double angle_noise = 0.0175;
    double angle_bias = 0.0175;
    double position_noise = 0.003;
};

template <class Visitor>
void describe_parameters(Visitor& v, KinematicsParameters& p) {
    v("angle_noise", p.angle_noise, Range{0, 0.5}, "rad",
      "σ of the camera's attitude about each axis, anew each frame");
    v("angle_bias", p.angle_bias, Range{0, 0.5}, "rad", "σ of its bias about each axis, drawn once a run");
    v("position_noise", p.position_noise, Range{0, 0.2}, "m",
      "σ of the camera's position along each axis, each frame");
}

class KinematicsModel {
  public:
    KinematicsModel(const KinematicsParameters& parameters, Random run);
    Eigen::Isometry3d measure(const Eigen::Isometry3d& T_BC, Random& frame) const;
    /// Of (translation, rotation vector in B), as kinematics_t states it.
    Eigen::Matrix<double, 6, 6> covariance() const;

  private:
    KinematicsParameters parameters_;
    Eigen::Vector3d bias_;  // rotation vector in B
};

}  // namespace goalmouth
