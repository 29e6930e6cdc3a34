#include "core/simulation/room.h"

namespace goalmouth {

using Eigen::Vector3d;

Room::Room(const FieldLayout& layout, const SceneParameters& parameters) : height_(parameters.room_height) {
    const double x = layout.carpet_half_length + parameters.room_margin;
    const double y = layout.carpet_half_width + parameters.room_margin;
    corners_ = {Vector3d(-x, -y, 0), Vector3d(x, -y, 0), Vector3d(x, y, 0), Vector3d(-x, y, 0)};
}

void Room::add_walls(Scene& scene, const Rgb& colour) const {
    const Rgb skirting{70, 66, 66};
    const Vector3d up(0, 0, height_);
    // The wall ends behind its skirting: two edges in one place would let the floor shine through.
    const Vector3d foot(0, 0, 0.05);
    for (std::size_t side = 0; side < 4; ++side) {
        const Vector3d& a = corner(side);
        const Vector3d& b = corner(side + 1);
        scene.panels.push_back({{a + foot, b + foot, b + up, a + up}, colour});
        scene.panels.push_back(patch(side, 0.0, length(side), 0.0, 0.1, skirting));
    }
}

Panel Room::patch(std::size_t side, double from, double to, double bottom, double top,
                  const Rgb& colour) const {
    const Vector3d& a = corner(side);
    const Vector3d along = (corner(side + 1) - a).normalized();
    // A millimetre into the room, so that nothing depends on which of two equal planes is nearer.
    const Vector3d inwards = 0.001 * Vector3d::UnitZ().cross(along);
    const Vector3d s = a + from * along + inwards;
    const Vector3d e = a + to * along + inwards;
    return {{s + Vector3d(0, 0, bottom), e + Vector3d(0, 0, bottom), e + Vector3d(0, 0, top),
             s + Vector3d(0, 0, top)},
            colour};
}

}  // namespace goalmouth
