#pragma once

#include "core/geometry/pose2.h"
#include "core/imaging/yuyv.h"
#include "core/simulation/renderer.h"
#include "tests/support/edge_at.h"

#include <cmath>

namespace goalmouth::test {

/// A hall in which every edge can be measured: one brightness for each thing, nothing in the way, no blur, no
/// noise.
inline SceneParameters plain_scene() {
    SceneParameters p;
    p.carpet = {60, 60, 60};
    p.line = {240, 240, 240};
    p.yellow_goal = {230, 230, 230};
    p.ball = {250, 250, 250};
    p.floor = {140, 140, 140};
    p.wall = {20, 20, 20};
    p.mottle = 0.0;
    p.goal_frame = false;
    p.posters = 0;
    p.spectators = 0;
    return p;
}

inline LightParameters plain_light() {
    LightParameters p;
    p.ambient = 1.0;
    p.directional = 0.0;
    p.limb_darkening = 0.0;
    return p;
}

inline SensorParameters ideal_sensor() {
    return {.blur = 0.0, .read_noise = 0.0};
}

inline ImageFormationParameters plain_formation() {
    ImageFormationParameters p;
    p.light = plain_light();
    p.sensor = ideal_sensor();
    return p;
}

/// A shot of a camera that does not move.
inline Shot still(const Eigen::Isometry3d& T_WC) {
    Shot shot;
    shot.camera.T_WC = T_WC;
    return shot;
}

inline YuyvImage render_plain(const Field& field, const SceneParameters& scene, const Intrinsics& camera,
                              const Eigen::Isometry3d& T_WC) {
    Renderer renderer(make_scene(field, scene), camera, plain_formation());
    Random random(1);
    return renderer.render(still(T_WC), random);
}

/// Camera at x, y on the field, heading theta.
inline Eigen::Isometry3d camera_at(double x, double y, double theta, double height, double roll,
                                   double pitch) {
    return on_ground({x, y, theta}) * camera_in_body(height, roll, pitch);
}

/// Share of `inside` against `outside` in the luma of pixels first…last of a row (or column), summed: how
/// many pixels of it.
inline double covered_in_row(const YuyvImage& image, int row, int first, int last, double inside,
                             double outside) {
    double sum = 0.0;
    for (int x = first; x <= last; ++x) sum += (image.view().at(x, row).y - outside) / (inside - outside);
    return sum;
}
inline double covered_in_column(const YuyvImage& image, int column, int first, int last, double inside,
                                double outside) {
    double sum = 0.0;
    for (int y = first; y <= last; ++y) sum += (image.view().at(column, y).y - outside) / (inside - outside);
    return sum;
}

}  // namespace goalmouth::test
