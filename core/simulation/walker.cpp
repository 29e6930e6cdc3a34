#include "core/simulation/walker.h"

#include "core/geometry/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace goalmouth {
namespace {

constexpr double tick_seconds = 0.01;
constexpr double servo_seconds = 0.15;  // time constant of a head joint
constexpr double turn = 2.0 * std::numbers::pi;

Eigen::Matrix3d rotation(const Eigen::Vector3d& vector) {
    const double angle = vector.norm();
    if (angle < 1e-12) return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

Eigen::Vector3d normal_vector(double sigma, Random& random) {
    const double x = random.normal();
    const double y = random.normal();
    const double z = random.normal();
    return sigma * Eigen::Vector3d(x, y, z);
}

}  // namespace

Walker::Walker(const WalkParameters& parameters, const Field& field, Route route, Random run)
    : parameters_(parameters),
      goals_{Eigen::Vector2d(-field.length / 2.0, 0.0), Eigen::Vector2d(field.length / 2.0, 0.0)},
      route_(std::move(route)),
      odometry_(parameters.odometry, run) {
    // The head has found its goal before the robot sets out.
    pan_ = look_at_goal(pose_at(0.0), 0.0);
    tilt_ = parameters_.head.tilt;
}

double Walker::distance_at(double time) const {
    const double v = parameters_.gait.speed;
    const double a = parameters_.gait.acceleration;
    const double ramp = v / a;
    return time < ramp ? 0.5 * a * time * time : v * (time - 0.5 * ramp);
}

std::int64_t Walker::footstep_at(double time) const {
    return static_cast<std::int64_t>(std::floor(2.0 * parameters_.gait.frequency * time));
}

double Walker::look_at_goal(const Pose2& pose, double time) {
    const HeadParameters& head = parameters_.head;
    const auto bearing = [&](int goal) {
        const Eigen::Vector2d g = inverse_transform(pose, goals_[static_cast<std::size_t>(goal)]);
        return std::atan2(g.y(), g.x());
    };
    const double swing = std::sin(turn * time / head.sweep_period);
    if (goal_ >= 0 && std::abs(bearing(goal_)) > head.pan_limit) goal_ = -1;
    if (goal_ < 0) {
        // A goal is taken only well within reach, and kept until it is out of reach: the head does not
        // dither.
        double nearest = std::numeric_limits<double>::infinity();
        for (const int g : {0, 1}) {
            const double distance = (goals_[static_cast<std::size_t>(g)] - pose.position()).norm();
            if (std::abs(bearing(g)) < 0.9 * head.pan_limit && distance < nearest) {
                nearest = distance;
                goal_ = g;
            }
        }
    }
    const double wanted = goal_ < 0 ? head.search_sweep * swing : bearing(goal_) + head.sweep * swing;
    return std::clamp(wanted, -head.pan_limit, head.pan_limit);
}

void Walker::advance(double time) {
    assert(time >= time_);
    const HeadParameters& head = parameters_.head;
    const auto ticks = static_cast<std::int64_t>(std::floor(time / tick_seconds));
    for (; tick_ < ticks; ++tick_) {
        pan_ += pan_rate_ * tick_seconds;
        tilt_ += tilt_rate_ * tick_seconds;
        const double now = static_cast<double>(tick_ + 1) * tick_seconds;
        const Pose2 before = pose_at(static_cast<double>(tick_) * tick_seconds);
        const Pose2 after = pose_at(now);
        odometry_.move(difference(before, after), footstep_at(now));
        const double pan = look_at_goal(after, now);
        const double tilt = head.tilt + head.tilt_sweep * std::sin(turn * now / head.tilt_period);
        pan_rate_ = std::clamp((pan - pan_) / servo_seconds, -head.speed, head.speed);
        tilt_rate_ = std::clamp((tilt - tilt_) / servo_seconds, -head.speed, head.speed);
    }
    time_ = time;
}

Pose2 Walker::odometry() const {
    // Since the last tick the body moved a little more: counted without slip, which the next tick puts right.
    const Pose2 last = pose_at(static_cast<double>(tick_) * tick_seconds);
    return compose(odometry_.pose(), difference(last, pose()));
}

Eigen::Isometry3d Walker::T_BC_at(double time) const {
    const GaitParameters& gait = parameters_.gait;
    const double ramp = gait.speed > 0.0 ? std::min(1.0, time * gait.acceleration / gait.speed) : 0.0;
    const double phase = turn * gait.frequency * time;
    // No two cycles are alike: the sway itself swells and fades slowly.
    const double swell = ramp * (0.8 + 0.2 * std::sin(0.61 * time));
    const double roll = swell * gait.roll * std::sin(phase);
    const double pitch = ramp * gait.pitch * std::sin(2.0 * phase + 0.7);
    const double sway = -swell * gait.sway * std::sin(phase);
    const double bob = ramp * gait.bob * std::cos(2.0 * phase);

    const double since_tick = time - static_cast<double>(tick_) * tick_seconds;
    Eigen::Isometry3d head = camera_in_body(gait.camera_height, 0.0, tilt_ + tilt_rate_ * since_tick,
                                            pan_ + pan_rate_ * since_tick);
    head.translation().x() = gait.camera_forward;
    Eigen::Isometry3d body = Eigen::Isometry3d::Identity();
    body.linear() = (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()) *
                     Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()))
                        .toRotationMatrix();
    body.translation() = Eigen::Vector3d(0.0, sway, bob);
    return body * head;
}

Eigen::Isometry3d Walker::T_WC_at(double time) const {
    return on_ground(pose_at(time)) * T_BC_at(time);
}

CameraMotion Walker::motion() const {
    // Central differences: of steps so small that the gait's third derivative does not show.
    constexpr double step = 1e-4;  // s
    const double from = std::max(0.0, time_ - step);
    const double to = time_ + step;
    const Eigen::Isometry3d before = T_WC_at(from);
    const Eigen::Isometry3d after = T_WC_at(to);
    CameraMotion motion;
    motion.T_WC = T_WC();
    if (before.matrix() == after.matrix()) return motion;
    motion.velocity = (after.translation() - before.translation()) / (to - from);
    const Eigen::AngleAxisd turned(Eigen::Matrix3d(before.linear().transpose() * after.linear()));
    motion.turn_rate = turned.angle() / (to - from) * turned.axis();
    return motion;
}

KinematicsModel::KinematicsModel(const KinematicsParameters& parameters, Random run)
    : parameters_(parameters), bias_(normal_vector(parameters.angle_bias, run)) {}

Eigen::Isometry3d KinematicsModel::measure(const Eigen::Isometry3d& T_BC, Random& frame) const {
    Eigen::Isometry3d measured = T_BC;
    measured.translation() += normal_vector(parameters_.position_noise, frame);
    measured.linear() = rotation(bias_ + normal_vector(parameters_.angle_noise, frame)) * T_BC.linear();
    return measured;
}

Eigen::Matrix<double, 6, 6> KinematicsModel::covariance() const {
    const double position = parameters_.position_noise * parameters_.position_noise;
    const double angle =
        parameters_.angle_noise * parameters_.angle_noise + parameters_.angle_bias * parameters_.angle_bias;
    Eigen::Matrix<double, 6, 1> diagonal;
    diagonal << position, position, position, angle, angle, angle;
    return diagonal.asDiagonal();
}

}  // namespace goalmouth
