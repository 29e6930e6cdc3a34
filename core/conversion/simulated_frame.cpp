#include "core/conversion/simulated_frame.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/odometry.h"

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
    return to_message(OdometrySample{.utime = utime,
                                     .pose = frame.odometry,
                                     .translation_noise = noise.translation_noise,
                                     .rotation_noise = noise.rotation_noise},
                      seq);
}

}  // namespace goalmouth
