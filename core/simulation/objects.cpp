#include "core/simulation/objects.h"

#include "core/geometry/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace goalmouth {
namespace {

using Eigen::Vector3d;

constexpr double margin = 2.0;  // px around a projected outline: the pixels its edge may still cross

}  // namespace

PixelBox box_of(std::span<const Eigen::Vector3d> corners, const Intrinsics& camera) {
    const PixelBox all{0, 0, camera.width - 1, camera.height - 1};
    double left = std::numeric_limits<double>::infinity(), top = left, right = -left, bottom = -left;
    bool behind = true;
    bool near = false;
    for (const Vector3d& p : corners) {
        if (p.z() > 0.0) behind = false;
        // Far outside the image a lens's distortion polynomial turns back, so a corner there proves nothing.
        const double reach = std::hypot(p.x(), p.y());
        if (p.z() < 0.05 || (camera.has_distortion() && reach > 1.2 * p.z())) {
            near = true;
            continue;
        }
        const Eigen::Vector2d pixel = *project(camera, p);
        left = std::min(left, pixel.x());
        right = std::max(right, pixel.x());
        top = std::min(top, pixel.y());
        bottom = std::max(bottom, pixel.y());
    }
    if (behind) return {};
    if (near) return all;
    // A straight edge between two corners bends under distortion: by less than this share of the box.
    const double bend = camera.has_distortion() ? 0.1 : 0.0;
    const double bend_x = margin + bend * (right - left);
    const double bend_y = margin + bend * (bottom - top);
    const auto clamped = [](double value, int size) {
        return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(size)));
    };
    return {std::max(0, clamped(std::floor(left - bend_x), camera.width)),
            std::max(0, clamped(std::floor(top - bend_y), camera.height)),
            std::min(camera.width - 1, clamped(std::ceil(right + bend_x), camera.width)),
            std::min(camera.height - 1, clamped(std::ceil(bottom + bend_y), camera.height))};
}

SeenObject::SeenObject(const PixelBox& box, const SeenBody& body)
    : box_(box), body_(body), distance_(distance_to_segment<3>(body.from, body.to, Vector3d::Zero())) {}

SeenObject::Columns SeenObject::columns_inside(std::span<const EdgePlane> edges, const RowRays& rays) const {
    if (!rays.straight || box_.left == box_.right) return {box_.left, box_.right};
    return columns_between(edges, rays, 1.5F);
}

SeenObject::Columns SeenObject::columns_between(std::span<const EdgePlane> edges, const RowRays& rays,
                                                float margin) const {
    const float* x = rays.x;
    const float* y = rays.y;
    const auto width = static_cast<float>(box_.right - box_.left);
    float first = 0.0F;
    float last = width;
    for (const EdgePlane& e : edges) {
        // The distance grows evenly along a row.
        const float start = e.distance(x[box_.left], y[box_.left]) + margin;
        const float end = e.distance(x[box_.right], y[box_.right]) + margin;
        if (start < 0.0F && end < 0.0F) return {0, -1};
        const float crossing = width * start / (start - end);
        if (start < 0.0F) first = std::max(first, crossing);
        if (end < 0.0F) last = std::min(last, crossing);
    }
    return {box_.left + static_cast<int>(std::floor(first)), box_.left + static_cast<int>(std::ceil(last))};
}

EdgePlane::EdgePlane(const Vector3d& normal, const Intrinsics& camera)
    : nx(0), ny(0), nz(0), coverage(0.0F, 0.0F) {
    const double gu = normal.x() / camera.fx;
    const double gv = normal.y() / camera.fy;
    const double scale = 1.0 / std::max(1e-12, std::sqrt(gu * gu + gv * gv));
    nx = static_cast<float>(scale * normal.x());
    ny = static_cast<float>(scale * normal.y());
    nz = static_cast<float>(scale * normal.z());
    coverage = EdgeCoverage(static_cast<float>(scale * gu), static_cast<float>(scale * gv));
}

}  // namespace goalmouth
