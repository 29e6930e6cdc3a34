#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/random/random.h"
#include "core/simulation/ground.h"
#include "core/simulation/light.h"
#include "core/simulation/objects.h"
#include "core/simulation/ray_table.h"
#include "core/simulation/scene.h"
#include "core/simulation/sensor.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// Frames of a scene by analytic ray casting: each row is painted from far to near (ground, walls, cylinders,
/// ball) with the exact share of every pixel that an edge cuts, then handed to the sensor. A frame is a
/// function of scene, camera, pose and the state of `random`.
class Renderer {
  public:
    Renderer(Scene scene, const Intrinsics& camera, const LightParameters& light = {},
             const SensorParameters& sensor = {});
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// The camera must be above the ground and within the room. `out` holds height rows of `stride` bytes,
    /// stride ≥ yuyv_row_bytes(width).
    void render(const Eigen::Isometry3d& T_WC, Random& random, std::uint8_t* out, std::ptrdiff_t stride);
    YuyvImage render(const Eigen::Isometry3d& T_WC, Random& random);

    const Scene& scene() const { return scene_; }
    const Intrinsics& camera() const { return rays_.camera(); }
    void move_ball(const Eigen::Vector2d& position);

  private:
    Scene scene_;
    Light light_;
    RayTable rays_;
    GroundPainter ground_;
    Sensor sensor_;
    std::vector<std::unique_ptr<SeenObject>> seen_;  // of the frame being painted, from far to near
};

}  // namespace goalmouth
