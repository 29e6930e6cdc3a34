#pragma once

#include "core/geometry/camera.h"
#include "core/geometry/cylinder.h"
#include "core/simulation/camera_motion.h"
#include "core/simulation/shutter.h"

#include <array>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// A post's side edge in the picture as it is [px], from top to base: a chain of points, each in a lower row
/// than the one before.
class EdgePath {
  public:
    explicit EdgePath(std::vector<Eigen::Vector2d> points) : points_(std::move(points)) {}

    bool empty() const { return points_.empty(); }
    double top() const { return points_.front().y(); }  // row
    double base() const { return points_.back().y(); }  // row
    /// x in a row; beyond top and base that of the end.
    double x_at(double row) const;
    /// The point in a row; beyond top and base the end.
    Eigen::Vector2d at(double row) const;

  private:
    std::vector<Eigen::Vector2d> points_;
};

/// The straight edge top…base of an undistorted picture [px] as the lens bends it, as far as the lens model
/// holds: outside the picture models fold back.
EdgePath bent_edge(const Intrinsics& camera, const Eigen::Vector2d& top, const Eigen::Vector2d& base);

/// Left and right edge of a post (cylinder in W) for a camera that moves while the rows are read one after
/// the other: each row shows the post as the camera stands when it is read. Still, or with all rows read at
/// once: bent_edge of project_edges. Empty where no part of the edge can be seen.
std::array<EdgePath, 2> edges_in_picture(const Intrinsics& camera, const CameraMotion& motion,
                                         const ShutterParameters& shutter, const Cylinder& post);

}  // namespace goalmouth
