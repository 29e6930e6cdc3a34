#include "core/simulation/in_view.h"

#include "core/geometry/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace goalmouth {
namespace {

using Eigen::Vector3d;

struct Sphere {
    Vector3d centre;
    double radius;
};

Sphere around(const Panel& panel) {
    const Vector3d centre = 0.5 * (panel.corners[0] + panel.corners[2]);
    double radius = 0.0;
    for (const Vector3d& corner : panel.corners) radius = std::max(radius, (corner - centre).norm());
    return {centre, radius};
}

Sphere around(const Tube& tube) {
    const Cylinder& c = tube.cylinder;
    return {0.5 * (c.base + c.top()), std::hypot(0.5 * c.length, c.radius)};
}

Sphere around(const Ball& ball) {
    return {ball.centre, ball.radius};
}

double distance_to(const Panel& panel, const Vector3d& point) {
    const Vector3d along = panel.corners[1] - panel.corners[0];
    const Vector3d up = panel.corners[3] - panel.corners[0];
    const Vector3d from = point - panel.corners[0];
    const auto share = [&](const Vector3d& side) {
        return std::clamp(from.dot(side) / std::max(1e-12, side.squaredNorm()), 0.0, 1.0);
    };
    return (from - share(along) * along - share(up) * up).norm();
}

double distance_to(const Tube& tube, const Vector3d& point) {
    const Cylinder& c = tube.cylinder;
    return std::max(0.0, distance_to_segment<3>(c.base, c.top(), point) - c.radius);
}

}  // namespace

Things all_things(const Scene& scene) {
    Things things;
    for (const Panel& panel : scene.panels) things.panels.push_back(&panel);
    for (const Tube& tube : scene.tubes) things.tubes.push_back(&tube);
    things.ball = &scene.ball;
    return things;
}

ViewLimits::ViewLimits(const RayTable& rays) : ViewLimits(rays, 0, rays.camera().height - 1) {}

ViewLimits::ViewLimits(const RayTable& rays, int first, int last)
    : left(std::numeric_limits<double>::infinity()), top(left), right(-left), bottom(-left) {
    const int width = rays.camera().width;
    const auto take = [&](const RowRays& row, int u) {
        left = std::min(left, static_cast<double>(row.x[u]));
        right = std::max(right, static_cast<double>(row.x[u]));
        top = std::min(top, static_cast<double>(row.y[u]));
        bottom = std::max(bottom, static_cast<double>(row.y[u]));
    };
    for (int v = first; v <= last; ++v) {
        const RowRays row = rays.row(v);
        if (v == first || v == last)
            for (int u = 0; u < width; ++u) take(row, u);
        take(row, 0);
        take(row, width - 1);
    }
    // An edge shows up to a pixel beyond the centre of the last one; the blur takes it no further.
    const double pixel = 2.0 / std::min(rays.camera().fx, rays.camera().fy);
    left -= pixel;
    top -= pixel;
    right += pixel;
    bottom += pixel;
}

Things things_in_view(const Things& all, const ViewLimits& limits, const CameraMotion& camera,
                      double seconds) {
    const Eigen::Isometry3d T_CW = camera.T_WC.inverse();
    // Planes through the camera's centre, their normals into the view.
    const Vector3d sides[] = {
        Vector3d(1.0, 0.0, -limits.left).normalized(), Vector3d(-1.0, 0.0, limits.right).normalized(),
        Vector3d(0.0, 1.0, -limits.top).normalized(), Vector3d(0.0, -1.0, limits.bottom).normalized()};
    const double turned = seconds * camera.turn_rate.norm();
    const double moved = seconds * camera.velocity.norm();
    const auto in_view = [&](const auto& thing) {
        const Sphere sphere = around(thing);
        const Vector3d centre = T_CW * sphere.centre;
        const double reach = sphere.radius + moved + turned * centre.norm();
        return std::all_of(std::begin(sides), std::end(sides),
                           [&](const Vector3d& side) { return side.dot(centre) > -reach; });
    };
    Things things;
    for (const Panel* panel : all.panels)
        if (in_view(*panel)) things.panels.push_back(panel);
    for (const Tube* tube : all.tubes)
        if (in_view(*tube)) things.tubes.push_back(tube);
    if (all.ball != nullptr && in_view(*all.ball)) things.ball = all.ball;
    return things;
}

double distance_to_nearest(const Things& things, const Vector3d& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Panel* panel : things.panels) nearest = std::min(nearest, distance_to(*panel, point));
    for (const Tube* tube : things.tubes) nearest = std::min(nearest, distance_to(*tube, point));
    if (things.ball != nullptr)
        nearest =
            std::min(nearest, std::max(0.0, (things.ball->centre - point).norm() - things.ball->radius));
    return nearest;
}

}  // namespace goalmouth
