#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// Angle wrapped to [−π, π).
double wrap_angle(double angle);

/// Pose of a body on the plane: position [m] and heading [rad, anticlockwise] in some frame.
struct Pose2 {
    double x = 0.0;
    double y = 0.0;
    double theta = 0.0;

    Eigen::Vector2d position() const { return {x, y}; }
};

/// `step`, given in the frame of `pose`, appended to it: T_ac = T_ab · T_bc. The heading is wrapped.
Pose2 compose(const Pose2& pose, const Pose2& step);

/// `to` seen from `from`: compose(from, difference(from, to)) == to.
Pose2 difference(const Pose2& from, const Pose2& to);

/// Point given in the frame of `pose`, in the frame `pose` is given in.
Eigen::Vector2d transform(const Pose2& pose, const Eigen::Vector2d& point);

/// Point in the frame of `pose`, given in the frame `pose` is given in.
Eigen::Vector2d inverse_transform(const Pose2& pose, const Eigen::Vector2d& point);

/// Between a (share 0) and b (share 1); the heading takes the short way round.
Pose2 interpolate(const Pose2& a, const Pose2& b, double share);

/// The same pose in space: T_WB of a body that stands upright on the ground of frame W.
Eigen::Isometry3d on_ground(const Pose2& pose);

}  // namespace goalmouth
