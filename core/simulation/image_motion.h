#pragma once

#include "core/geometry/camera.h"
#include "core/simulation/camera_motion.h"
#include "core/simulation/shutter.h"

namespace goalmouth {

/// Fastest movement of anything across the image [px/s], at the frame's time: things at `nearest` [m] or
/// farther, and the ground z = 0. The image is taken as without distortion; a lens that pulls its rim in
/// moves things there more slowly, one that stretches it faster.
double image_speed(const Intrinsics& camera, const CameraMotion& motion, double nearest);

/// How finely a moving camera's frame is made.
struct ShutterSampling {
    int band_rows =
        1;  // rows that share one set-up of the scene: 1…16, such that nothing moves by more than
            // half a pixel between a row and the middle of its band; all where they are read at once
    int samples = 1;  // instants in the exposure of a row, 2…16 where it lasts
};

/// `speed` [px/s] as image_speed() has it; `blur` [px]: σ of the optical blur. Instants lie a pixel apart or
/// 2σ, whichever is more: the pixel's square, or the blur, then leaves less than 1 % of ripple in a smeared
/// edge.
ShutterSampling shutter_sampling(const ShutterParameters& shutter, int height, double speed, double blur);

}  // namespace goalmouth
