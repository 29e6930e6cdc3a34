#pragma once

#include "core/simulation/camera_motion.h"
#include "core/simulation/ray_table.h"
#include "core/simulation/scene.h"

#include <vector>

namespace goalmouth {

/// Things of a scene, which must outlive it and not change.
struct Things {
    std::vector<const Panel*> panels;
    std::vector<const Tube*> tubes;
    const Ball* ball = nullptr;
};

Things all_things(const Scene& scene);

/// How far the image reaches, as rays (x, y, 1).
struct ViewLimits {
    explicit ViewLimits(const RayTable& rays);
    /// Of some of its rows, both included.
    ViewLimits(const RayTable& rays, int first, int last);
    double left, top, right, bottom;
};

/// Those of `things` that can come into view within `seconds` before and after the middle of a movement, and
/// perhaps a little more.
Things things_in_view(const Things& things, const ViewLimits& limits, const CameraMotion& camera,
                      double seconds);

/// From a point to the nearest of them [m]; 0 within one.
double distance_to_nearest(const Things& things, const Eigen::Vector3d& point);

}  // namespace goalmouth
