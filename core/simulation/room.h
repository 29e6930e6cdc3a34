#pragma once

#include "core/simulation/scene.h"

#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace goalmouth {

/// The four walls about a field. Sides are numbered anticlockwise as seen from above, beginning at y < 0;
/// each is measured along that way round.
class Room {
  public:
    Room(const FieldLayout& layout, const SceneParameters& parameters);

    double height() const { return height_; }  // m
    /// Length of a side [m].
    double length(std::size_t side) const { return (corner(side + 1) - corner(side)).norm(); }

    /// Walls and their skirting.
    void add_walls(Scene& scene, const Rgb& colour) const;
    /// A rectangle on a side's wall, from…to [m] along it and bottom…top [m] up.
    Panel patch(std::size_t side, double from, double to, double bottom, double top, const Rgb& colour) const;

  private:
    const Eigen::Vector3d& corner(std::size_t i) const { return corners_[i % 4]; }

    double height_;
    std::array<Eigen::Vector3d, 4> corners_;
};

}  // namespace goalmouth
