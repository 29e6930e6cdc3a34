#pragma once

#include "core/alignment/sample_channel.h"
#include "core/geometry/camera_pose.h"

#include <cstdint>
#include <deque>
#include <optional>

namespace goalmouth {

struct KinematicsSample {
    std::int64_t utime = 0;
    CameraPose camera;
};

/// Where the camera was: the sample of that utime, or interpolated between two at most `wait` [s] apart.
/// Failing that, the nearest sample within `wait`.
std::optional<CameraPose> camera_at(const std::deque<KinematicsSample>& samples, std::int64_t utime,
                                    double wait);

}  // namespace goalmouth
