#include "core/conversion/simulated_frame.h"

#include "core/conversion/camera_pose.h"

namespace goalmouth {

kinematics_t kinematics_message(const SimulatedFrame& frame, std::int64_t utime, std::int64_t seq) {
    kinematics_t m = kinematics_message(frame.T_BC, utime, seq);
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            m.covariance[6 * row + column] = frame.T_BC_covariance(row, column);
    return m;
}

odometry_t odometry_message(const SimulatedFrame& frame, const OdometryParameters& noise, std::int64_t utime,
                            std::int64_t seq) {
    odometry_t m{};
    m.utime = utime;
    m.seq = seq;
    m.x = frame.odometry.x;
    m.y = frame.odometry.y;
    m.theta = frame.odometry.theta;
    m.translation_noise = noise.translation_noise;
    m.rotation_noise = noise.rotation_noise;
    return m;
}

}  // namespace goalmouth
