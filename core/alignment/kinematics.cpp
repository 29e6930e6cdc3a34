#include "core/alignment/kinematics.h"

namespace goalmouth {
namespace {

CameraPose interpolate(const CameraPose& a, const CameraPose& b, double share) {
    CameraPose result;
    result.T_BC.translation() = (1.0 - share) * a.T_BC.translation() + share * b.T_BC.translation();
    const Eigen::Quaterniond from(a.T_BC.linear());
    const Eigen::Quaterniond to(b.T_BC.linear());
    result.T_BC.linear() = from.slerp(share, to).toRotationMatrix();
    result.covariance = (1.0 - share) * a.covariance + share * b.covariance;
    return result;
}

}  // namespace

std::optional<CameraPose> camera_at(const std::deque<KinematicsSample>& samples, std::int64_t utime,
                                    double wait) {
    const auto near = around(samples, utime);
    if (near.before != nullptr && near.after != nullptr) {
        if (near.before->utime == utime) return near.before->camera;
        const double span = seconds_between(near.before->utime, near.after->utime);
        if (span <= wait) {
            return interpolate(near.before->camera, near.after->camera,
                               seconds_between(near.before->utime, utime) / span);
        }
    }
    if (const KinematicsSample* s = nearest(near, utime, wait)) return s->camera;
    return std::nullopt;
}

}  // namespace goalmouth
