#pragma once

#include "core/evaluation/cell.h"
#include "core/evaluation/evaluation_scene.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/random/random.h"
#include "core/simulation/camera_motion.h"

#include <optional>

namespace goalmouth {

/// A robot that is put between the camera and the post in line.
struct Occluder {
    double way = 0.5;       // share of the way from the camera to the post
    double sideways = 0.0;  // −1…1, of post width plus robot width, + left
    double heading = 0.0;   // rad
    bool fallen = false;
    bool magenta = false;  // its team marker; else cyan
};

/// Everything drawn for one frame of a cell, as far as it is not the hall's or the sensor's.
struct CellView {
    CameraMotion camera;
    Intrinsics told;    // what the detectors believe the camera to be
    double time = 0.0;  // s, when exposure and white balance are looked up
    std::optional<Occluder> occluder;
};

/// The camera as it is: the calibration file's, already at the picture's size, with the scene's lens.
Intrinsics true_camera(const Intrinsics& calibration, const LensParameters& lens);

/// The camera stands `cell.distance()` from the axis of the opponents' right post along the ground, in line
/// with it: the goal line lies square to the line from camera to post. It looks along that line but for yaw
/// and pitch, rolled by the cell's tilt to either side about its optical axis. Draws the same numbers in the
/// same order whatever the parameters, so that scenes differ by their parameters alone.
CellView draw_view(Random random, const EvaluationSceneParameters& parameters, const Field& field,
                   const EvaluationCell& cell, const Intrinsics& camera);

}  // namespace goalmouth
