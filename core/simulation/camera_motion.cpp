#include "core/simulation/camera_motion.h"

namespace goalmouth {

Eigen::Isometry3d CameraMotion::at(double seconds) const {
    Eigen::Isometry3d pose = T_WC;
    pose.translation() += seconds * velocity;
    const double rate = turn_rate.norm();
    if (rate > 0.0)
        pose.linear() =
            T_WC.linear() * Eigen::AngleAxisd(rate * seconds, turn_rate / rate).toRotationMatrix();
    return pose;
}

}  // namespace goalmouth
