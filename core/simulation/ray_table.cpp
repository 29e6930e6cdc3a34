#include "core/simulation/ray_table.h"

namespace goalmouth {

RayTable::RayTable(const Intrinsics& camera) : camera_(camera), straight_(!camera.has_distortion()) {
    const auto size = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    x_.resize(size);
    y_.resize(size);
    std::size_t i = 0;
    for (int v = 0; v < camera.height; ++v)
        for (int u = 0; u < camera.width; ++u, ++i) {
            const Eigen::Vector2d n = normalised_from_pixel(camera, {u, v});
            x_[i] = static_cast<float>(n.x());
            y_[i] = static_cast<float>(n.y());
        }
}

}  // namespace goalmouth
