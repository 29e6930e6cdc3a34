#pragma once

#include "core/detection/post.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/geometry/cylinder.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/post_colour.h"

#include <cstdint>
#include <functional>
#include <optional>

#include <Eigen/Core>

namespace goalmouth::test {

using Levels = Eigen::Vector3d;  // red, green, blue, 0…255

/// A post drawn by geometry alone, with nothing of core/simulation: exact coverage in pieces of a pixel,
/// blur, noise, clipping, 4:2:2. The camera stands at the origin of W and looks along x.
struct DrawnPost {
    Intrinsics camera = from_horizontal_fov(640, 480, 1.0472);
    double distance = 3.0;  // m, to the axis along the ground
    double bearing = 0.0;   // rad, of the post from x, + left
    double height = 0.42;   // m, of the camera
    double roll = 0.0, pitch = 0.04;
    double radius = 0.05, length = 0.95;
    Levels post{226, 184, 34};
    double limb_darkening = 0.25;
    double blur = 0.85;  // px
    double noise = 3.0;  // of each channel
    double black = 0.0;  // added to luma
    bool coded = false;  // pixels are light, which levels code as screens expect it (sRGB)
    std::uint64_t seed = 1;
    /// What stands behind at a pixel, and what before it; nothing: grey, and nothing.
    std::function<Levels(double x, double y)> behind;
    std::function<std::optional<Levels>(double x, double y)> before;

    Cylinder cylinder() const;
    Eigen::Isometry3d T_WC() const { return camera_in_body(height, roll, pitch); }
    YuyvImage draw() const;
    /// The post as a detector might say it: true edges (straight from end to end, inside the picture's rows),
    /// each moved to the right by so much [px].
    Post found(double left_moved = 0.0, double right_moved = 0.0) const;
    CameraPose pose(double sigma = 0.01) const;
};

/// Columns of a post's edges, and rows along it [px].
struct PostEdges {
    Post at;
    double left(double y) const { return along(at.left_top, at.left_base, y); }
    double right(double y) const { return along(at.right_top, at.right_base, y); }
    /// Row at a share of the way down.
    double row(double share) const { return at.left_top.y() + share * (at.left_base.y() - at.left_top.y()); }

  private:
    static double along(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double y) {
        return a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    }
};

/// Where the post is, and two rows less at either end.
RoughOutline rough_outline_of(const DrawnPost& scene);

/// The post's colour as its picture shows it.
PostColour colour_of(const DrawnPost& scene, YuyvView image);

/// A small picture where the post lies, to draw quickly.
DrawnPost small_scene();

}  // namespace goalmouth::test
