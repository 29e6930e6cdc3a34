#include "core/simulation/image_motion.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

double image_speed(const Intrinsics& camera, const CameraMotion& motion, double nearest) {
    using Eigen::Vector3d;
    constexpr int steps = 4;  // the flow is smooth: a grid finds its largest
    constexpr double closest = 0.02;
    const Eigen::Matrix3d R = motion.T_WC.linear();
    const Vector3d velocity = R.transpose() * motion.velocity;
    const double height = motion.T_WC.translation().z();
    double fastest = 0.0;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j) {
            const Vector3d d((i * (camera.width - 1) / static_cast<double>(steps) - camera.cx) / camera.fx,
                             (j * (camera.height - 1) / static_cast<double>(steps) - camera.cy) / camera.fy,
                             1.0);
            const auto speed = [&](double inverse_depth) {
                // What the camera sees of a resting point P: dP/dt = −ω×P − v, with P = d / inverse depth.
                const Vector3d rate = -motion.turn_rate.cross(d) - inverse_depth * velocity;
                return std::hypot(camera.fx * (rate.x() - d.x() * rate.z()),
                                  camera.fy * (rate.y() - d.y() * rate.z()));
            };
            const double fall = -R.row(2).dot(d);
            fastest = std::max({fastest, speed(0.0), speed(1.0 / std::max(closest, nearest))});
            if (fall > 0.0) fastest = std::max(fastest, speed(fall / std::max(closest, height)));
        }
    return fastest;
}

ShutterSampling shutter_sampling(const ShutterParameters& shutter, int height, double speed, double blur) {
    constexpr double most_rows = 16.0;
    constexpr double most_samples = 16.0;
    ShutterSampling sampling;
    const double drift = speed * shutter.readout / std::max(1, height - 1);  // px from row to row
    sampling.band_rows = shutter.readout > 0.0
                             ? static_cast<int>(std::clamp(1.0 / std::max(1e-9, drift), 1.0, most_rows))
                             : height;
    if (shutter.exposure > 0.0)
        sampling.samples = static_cast<int>(
            std::clamp(std::ceil(speed * shutter.exposure / std::max(1.0, 2.0 * blur)), 2.0, most_samples));
    return sampling;
}

}  // namespace goalmouth
