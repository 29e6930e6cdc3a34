#include "core/geometry/pose2.h"

#include <cmath>
#include <numbers>

namespace goalmouth {

double wrap_angle(double angle) {
    constexpr double turn = 2.0 * std::numbers::pi;
    const double wrapped = angle - turn * std::floor((angle + std::numbers::pi) / turn);
    return wrapped >= std::numbers::pi ? wrapped - turn : wrapped;
}

Eigen::Vector2d transform(const Pose2& pose, const Eigen::Vector2d& point) {
    const double c = std::cos(pose.theta);
    const double s = std::sin(pose.theta);
    return {pose.x + c * point.x() - s * point.y(), pose.y + s * point.x() + c * point.y()};
}

Eigen::Vector2d inverse_transform(const Pose2& pose, const Eigen::Vector2d& point) {
    const double c = std::cos(pose.theta);
    const double s = std::sin(pose.theta);
    const double dx = point.x() - pose.x;
    const double dy = point.y() - pose.y;
    return {c * dx + s * dy, -s * dx + c * dy};
}

Pose2 compose(const Pose2& pose, const Pose2& step) {
    const Eigen::Vector2d p = transform(pose, step.position());
    return {p.x(), p.y(), wrap_angle(pose.theta + step.theta)};
}

Pose2 difference(const Pose2& from, const Pose2& to) {
    const Eigen::Vector2d p = inverse_transform(from, to.position());
    return {p.x(), p.y(), wrap_angle(to.theta - from.theta)};
}

Pose2 interpolate(const Pose2& a, const Pose2& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
            wrap_angle(a.theta + share * wrap_angle(b.theta - a.theta))};
}

Eigen::Isometry3d on_ground(const Pose2& pose) {
    Eigen::Isometry3d T_WB = Eigen::Isometry3d::Identity();
    T_WB.linear() = Eigen::AngleAxisd(pose.theta, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T_WB.translation() = Eigen::Vector3d(pose.x, pose.y, 0.0);
    return T_WB;
}

}  // namespace goalmouth
