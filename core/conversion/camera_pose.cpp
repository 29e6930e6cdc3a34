#include "core/conversion/camera_pose.h"

namespace goalmouth {

Eigen::Isometry3d camera_pose(const kinematics_t& m) {
    const Eigen::Quaterniond rotation(m.quaternion[0], m.quaternion[1], m.quaternion[2], m.quaternion[3]);
    Eigen::Isometry3d T_BC = Eigen::Isometry3d::Identity();
    T_BC.linear() = rotation.normalized().toRotationMatrix();
    T_BC.translation() = Eigen::Vector3d(m.translation[0], m.translation[1], m.translation[2]);
    return T_BC;
}

kinematics_t kinematics_message(const Eigen::Isometry3d& T_BC, std::int64_t utime, std::int64_t seq) {
    kinematics_t m{};
    m.utime = utime;
    m.seq = seq;
    for (int i = 0; i < 3; ++i) m.translation[i] = T_BC.translation()[i];
    const Eigen::Quaterniond rotation(T_BC.linear());
    m.quaternion[0] = rotation.w();
    m.quaternion[1] = rotation.x();
    m.quaternion[2] = rotation.y();
    m.quaternion[3] = rotation.z();
    return m;
}

}  // namespace goalmouth
