#include "core/evaluation/measured_pose.h"

namespace goalmouth {

std::optional<CameraPose> measured_pose(const Eigen::Isometry3d& T_WC,
                                        const MeasuredPoseParameters& parameters, Random random) {
    Eigen::Vector3d turn;
    for (double& each : turn) each = parameters.attitude_sigma * random.normal();
    const double lift = parameters.height_sigma * random.normal();
    if (!parameters.told) return std::nullopt;

    CameraPose pose;
    pose.T_BC.linear() = T_WC.linear();
    const double angle = turn.norm();
    if (angle > 0.0) pose.T_BC.prerotate(Eigen::AngleAxisd(angle, turn / angle));
    pose.T_BC.translation() = Eigen::Vector3d(0.0, 0.0, T_WC.translation().z() + lift);
    pose.covariance(2, 2) = parameters.height_sigma * parameters.height_sigma;
    for (Eigen::Index i = 3; i < 6; ++i)
        pose.covariance(i, i) = parameters.attitude_sigma * parameters.attitude_sigma;
    return pose;
}

}  // namespace goalmouth
