#include "core/conversion/odometry.h"

namespace goalmouth {

OdometrySample from_message(const odometry_t& m) {
    OdometrySample sample;
    sample.utime = m.utime;
    sample.pose = {m.x, m.y, m.theta};
    sample.translation_noise = m.translation_noise;
    sample.rotation_noise = m.rotation_noise;
    return sample;
}

odometry_t to_message(const OdometrySample& sample, std::int64_t seq) {
    odometry_t m{};
    m.utime = sample.utime;
    m.seq = seq;
    m.x = sample.pose.x;
    m.y = sample.pose.y;
    m.theta = sample.pose.theta;
    m.translation_noise = sample.translation_noise;
    m.rotation_noise = sample.rotation_noise;
    return m;
}

}  // namespace goalmouth
