#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/random/random.h"
#include "core/simulation/camera_motion.h"
#include "core/simulation/ground.h"
#include "core/simulation/image_formation.h"
#include "core/simulation/in_view.h"
#include "core/simulation/light.h"
#include "core/simulation/processing.h"
#include "core/simulation/ray_table.h"
#include "core/simulation/scene.h"
#include "core/simulation/sensor.h"
#include "core/simulation/shutter.h"
#include "core/simulation/view.h"

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// How one frame is taken.
struct Shot {
    CameraMotion camera;
    Rgb gains{1.0F, 1.0F, 1.0F};  // Exposure::gains at the frame's time
};

/// Frames of a scene by analytic ray casting: each row is painted from far to near (ground, walls, cylinders,
/// ball) with the exact share of every pixel that an edge cuts, then handed to the sensor. Where the camera
/// moves, each row is the mean of what several instants of its own exposure see; the frame's time is the
/// middle of the readout. A frame is a function of scene, camera, shot and the state of `random`.
class Renderer {
  public:
    /// `formation.hall` and `formation.exposure` are not read: the scene and each shot's gains are given.
    Renderer(Scene scene, const Intrinsics& camera, const ImageFormationParameters& formation = {});
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// The camera must stay above the ground and within the room. `out` holds height rows of `stride` bytes,
    /// stride ≥ yuyv_row_bytes(width). Throws std::runtime_error where the JPEG codec fails.
    void render(const Shot& shot, Random& random, std::uint8_t* out, std::ptrdiff_t stride);
    YuyvImage render(const Shot& shot, Random& random);

    /// Another hall on the same field, for the frames to come; cheap beside a new renderer.
    void change_scene(Scene scene);

    const Scene& scene() const { return scene_; }
    const Intrinsics& camera() const { return rays_.camera(); }

  private:
    void paint_still(const Eigen::Isometry3d& T_WC);
    void paint_moving(const CameraMotion& motion);
    /// `T_WC`: of the row; what of it the view leaves open is ground.
    void paint_row(View& view, const RowRays& rays, const Eigen::Isometry3d& T_WC, const LightRow& light);
    LightRow sample_row();

    Scene scene_;
    Light light_;
    ShutterParameters shutter_;
    double blur_;  // px
    RayTable rays_;
    ViewLimits limits_;
    GroundPainter ground_;
    Sensor sensor_;
    Processing processing_;
    std::vector<View> views_;    // of the frame being painted: one for each instant of the exposure
    std::vector<float> sample_;  // one row of one such instant
};

}  // namespace goalmouth
