#include "core/evaluation/cell_view.h"

#include "core/geometry/pose2.h"

#include <algorithm>
#include <numbers>

namespace goalmouth {
namespace {

constexpr double longest_time = 1000.0;  // s: many periods of the exposure's wander

}  // namespace

Intrinsics true_camera(const Intrinsics& calibration, const LensParameters& lens) {
    Intrinsics camera = calibration;
    camera.distortion = {lens.k1, lens.k2, lens.p1, lens.p2, 0.0};
    return camera;
}

CellView draw_view(Random random, const EvaluationSceneParameters& parameters, const Field& field,
                   const EvaluationCell& cell, const Intrinsics& camera) {
    CellView result;
    const ViewParameters& view = parameters.view;
    const double yaw = random.uniform(-view.yaw, view.yaw);
    const double pitch = random.uniform(view.pitch_lowest, view.pitch_highest);
    const double side = random.index(2) == 0 ? -1.0 : 1.0;
    const Eigen::Vector2d post = field.posts()[post_in_line];
    Eigen::Isometry3d& T_WC = result.camera.T_WC;
    T_WC = camera_in_body(view.camera_height, side * cell.tilt(), pitch, yaw);
    T_WC.pretranslate(Eigen::Vector3d(post.x() - cell.distance(), post.y(), 0.0));

    const CameraMotionParameters& motion = parameters.motion;
    const double along = random.normal();
    const double across = random.normal();
    result.camera.velocity = motion.speed * Eigen::Vector3d(along, across, 0.0);
    const double about_x = random.normal();
    const double about_y = random.normal();
    const double about_axis = random.normal();
    result.camera.turn_rate = {motion.pitch_rate * about_x, motion.yaw_rate * about_y,
                               motion.roll_rate * about_axis};

    const LensParameters& lens = parameters.lens;
    result.told = camera;
    if (!lens.distortion_known) result.told.distortion = {};
    const double focal = 1.0 + lens.focal_error * random.normal();
    result.told.fx *= focal;
    result.told.fy *= focal;
    const double centre_error = lens.centre_error * camera.width / 640.0;
    result.told.cx += centre_error * random.normal();
    result.told.cy += centre_error * random.normal();

    result.time = random.uniform(0.0, longest_time);

    const bool occluded = random.uniform() < parameters.occluders.share;
    Occluder occluder;
    occluder.fallen = random.index(2) == 1;
    // At least clear of both: the paper's nearest cell leaves 10 cm to choose from.
    constexpr double clear = 0.25;  // m
    const double nearest = std::max(0.25 * cell.distance(), clear);
    const double farthest = std::min(0.75 * cell.distance(), cell.distance() - clear);
    occluder.way = random.uniform(nearest, farthest) / cell.distance();
    occluder.sideways = random.uniform(-1.0, 1.0);
    occluder.heading = random.uniform(-std::numbers::pi, std::numbers::pi);
    occluder.magenta = random.index(2) == 1;
    if (occluded) result.occluder = occluder;
    return result;
}

}  // namespace goalmouth
