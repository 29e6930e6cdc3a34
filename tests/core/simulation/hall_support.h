#pragma once

#include "core/simulation/ground.h"
#include "core/simulation/objects.h"
#include "core/simulation/ray_table.h"
#include "tests/core/simulation/measured.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace goalmouth::test {

/// One channel of light, before any sensor.
struct LightImage {
    int width = 0, height = 0;
    std::vector<float> light;

    LightImage(int w, int h)
        : width(w), height(h), light(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    float& at(int x, int y) {
        return light[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)];
    }
    double at(int x, int y) const {
        return static_cast<double>(light[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                         static_cast<std::size_t>(x)]);
    }
    double column(int x, int first, int last) const {
        double sum = 0.0;
        for (int y = first; y <= last; ++y) sum += at(x, y);
        return sum;
    }
    double row(int y, int first, int last) const {
        double sum = 0.0;
        for (int x = first; x <= last; ++x) sum += at(x, y);
        return sum;
    }
};

template <class Paint>
LightImage painted(const RayTable& rays, const Paint& paint) {
    const Intrinsics& camera = rays.camera();
    LightImage image(camera.width, camera.height);
    std::vector<float> other(static_cast<std::size_t>(camera.width));
    for (int y = 0; y < camera.height; ++y)
        paint(y, rays.row(y), LightRow{&image.at(0, y), other.data(), other.data(), camera.width});
    return image;
}

/// Share of the lamps' light that each pixel of the ground loses to shadows: from the ground painted with and
/// without them.
inline LightImage lost_light(const Scene& scene, LightParameters light, const RayTable& rays,
                             const Eigen::Isometry3d& T_WC) {
    const Intrinsics& camera = rays.camera();
    const auto ground = [&](bool shadows) {
        light.shadows = shadows;
        GroundPainter painter(scene, Light(light), camera);
        painter.look(T_WC);
        return painted(rays, [&](int, const RowRays& row, const LightRow& out) { painter.paint(row, out); });
    };
    LightImage with = ground(true);
    const LightImage without = ground(false);
    const double share = Light(light).lamps_share_on_ground();
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x)
            with.at(x, y) = static_cast<float>((1.0 - with.at(x, y) / without.at(x, y)) / share);
    return with;
}

/// Share of each pixel that a thing covers.
template <class Thing>
LightImage covered_by(Thing thing, const RayTable& rays, const Eigen::Isometry3d& T_WC) {
    thing.colour = {1.0F, 1.0F, 1.0F};
    const Light light(plain_light());
    const auto seen = see(thing, light, rays, T_WC);
    return painted(rays, [&](int y, const RowRays& row, const LightRow& out) {
        if (seen && y >= seen->box().top && y <= seen->box().bottom)
            seen->paint(row, seen->columns(row), out);
    });
}

/// Where a ray meets a closed cylinder, ends included, as a multiple of `direction`: by cutting the ray with
/// the slab between the ends and with the endless cylinder, as a check of what is derived otherwise.
inline std::optional<double> meets_solid(const Cylinder& c, const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& direction) {
    const Eigen::Vector3d to = from - c.base;
    const double along = to.dot(c.axis), run = direction.dot(c.axis);
    double enter = 0.0, leave = 1e9;
    const auto cut = [&](double first, double last) {
        enter = std::max(enter, std::min(first, last));
        leave = std::min(leave, std::max(first, last));
    };
    if (run != 0.0)
        cut(-along / run, (c.length - along) / run);
    else if (along < 0.0 || along > c.length)
        return std::nullopt;
    const Eigen::Vector3d p = to - along * c.axis;
    const Eigen::Vector3d d = direction - run * c.axis;
    const double a = d.squaredNorm(), b = p.dot(d), k = p.squaredNorm() - c.radius * c.radius;
    if (a > 0.0) {
        if (b * b < a * k) return std::nullopt;
        const double root = std::sqrt(b * b - a * k);
        cut((-b - root) / a, (-b + root) / a);
    } else if (k > 0.0) {
        return std::nullopt;
    }
    if (enter >= leave) return std::nullopt;
    return enter;
}

}  // namespace goalmouth::test
