#include "core/simulation/renderer.h"

#include <algorithm>
#include <utility>

namespace goalmouth {

Renderer::Renderer(Scene scene, const Intrinsics& camera, const LightParameters& light,
                   const SensorParameters& sensor)
    : scene_(std::move(scene)),
      light_(light),
      rays_(camera),
      ground_(scene_, light_, camera),
      sensor_(sensor, camera.width, camera.height) {}

void Renderer::move_ball(const Eigen::Vector2d& position) {
    scene_.ball.centre = {position.x(), position.y(), scene_.ball.radius};
}

void Renderer::render(const Eigen::Isometry3d& T_WC, Random& random, std::uint8_t* out,
                      std::ptrdiff_t stride) {
    seen_.clear();
    const auto add = [&](const auto& thing) {
        if (auto seen = see(thing, light_, rays_, T_WC)) seen_.push_back(std::move(seen));
    };
    for (const Panel& panel : scene_.panels) add(panel);
    const auto panels = static_cast<std::ptrdiff_t>(seen_.size());
    for (const Tube& tube : scene_.tubes) add(tube);
    add(scene_.ball);
    std::stable_sort(seen_.begin() + panels, seen_.end(),
                     [](const auto& a, const auto& b) { return a->distance() > b->distance(); });

    ground_.look(T_WC);
    sensor_.begin(out, stride, random);
    for (int row = 0; row < camera().height; ++row) {
        const LightRow light = sensor_.next_row();
        const RowRays rays = rays_.row(row);
        ground_.paint(rays, light);
        for (const auto& object : seen_)
            if (row >= object->box().top && row <= object->box().bottom) object->paint(rays, light);
        sensor_.finish_row();
    }
    seen_.clear();
}

YuyvImage Renderer::render(const Eigen::Isometry3d& T_WC, Random& random) {
    YuyvImage image(camera().width, camera().height);
    render(T_WC, random, image.data.data(), image.stride());
    return image;
}

}  // namespace goalmouth
