#include "core/conversion/kinematics.h"

#include "core/conversion/camera_pose.h"

namespace goalmouth {

KinematicsSample from_message(const kinematics_t& m) {
    KinematicsSample sample;
    sample.utime = m.utime;
    sample.camera.T_BC = camera_pose(m);
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(m.covariance);
    sample.camera.covariance = 0.5 * (covariance + covariance.transpose());
    return sample;
}

kinematics_t to_message(const KinematicsSample& sample, std::int64_t seq) {
    kinematics_t m = kinematics_message(sample.camera.T_BC, sample.utime, seq);
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(m.covariance) = sample.camera.covariance;
    return m;
}

}  // namespace goalmouth
