#include "core/simulation/view.h"

#include "core/simulation/painting_order.h"
#include "core/simulation/vectorised.h"

#include <algorithm>
#include <utility>

namespace goalmouth {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// Of the plane n·P = k, frame C.
Vector3f inverse_depth(const Vector3d& normal, double k) {
    return (normal / k).cast<float>();
}

Vector3f plane_of(const Panel& panel, const Eigen::Isometry3d& T_CW) {
    const Vector3d corner = T_CW * panel.corners[0];
    const Vector3d normal =
        T_CW.linear() *
        (panel.corners[1] - panel.corners[0]).cross(panel.corners[3] - panel.corners[0]).normalized();
    return inverse_depth(normal, normal.dot(corner));
}

/// The plane that faces the camera and holds the lines or the circle in which its rays touch the body.
Vector3f plane_of(const SeenBody& body) {
    const Vector3d run = body.to - body.from;
    const double length = run.norm();
    Vector3d ahead = body.from;
    if (length > 0.0) ahead -= run * (run.dot(body.from) / (length * length));
    const double distance = std::max(ahead.norm(), 1.001 * body.radius);
    return inverse_depth(ahead / distance, distance - body.radius * body.radius / distance);
}

GOALMOUTH_VECTORISED void turn_rays(const Matrix3f& H, const RowRays& rays, int first, int last, float* x,
                                    float* y) {
    const float h00 = H(0, 0), h01 = H(0, 1), h02 = H(0, 2);
    const float h10 = H(1, 0), h11 = H(1, 1), h12 = H(1, 2);
    const float h20 = H(2, 0), h21 = H(2, 1), h22 = H(2, 2);
    for (int u = first; u <= last; ++u) {
        const float rx = rays.x[u];
        const float ry = rays.y[u];
        const float z = h20 * rx + h21 * ry + h22;
        const float scale = 1.0F / std::max(z, 0.5F);  // of rays that miss the thing it can be anything
        x[u] = scale * (h00 * rx + h01 * ry + h02);
        y[u] = scale * (h10 * rx + h11 * ry + h12);
    }
}

}  // namespace

void View::look(const Things& things, const Light& light, const RayTable& rays,
                const Eigen::Isometry3d& T_WC) {
    T_WC_ = T_WC;
    const auto width = static_cast<std::size_t>(rays.camera().width);
    x_.resize(width);
    y_.resize(width);
    seen_.clear();
    solid_.clear();
    const Eigen::Isometry3d T_CW = T_WC.inverse();
    for (const Panel* panel : things.panels)
        if (auto seen = see(*panel, light, rays, T_WC))
            seen_.push_back({std::move(seen), plane_of(*panel, T_CW)});
    const auto add = [&](const auto& thing) {
        if (auto seen = see(thing, light, rays, T_WC)) solid_.push_back(std::move(seen));
    };
    for (const Tube* tube : things.tubes) add(*tube);
    if (things.ball != nullptr) add(*things.ball);
    sort_for_painting(solid_);
    for (auto& object : solid_) {
        const Vector3f plane = plane_of(object->body());
        seen_.push_back({std::move(object), plane});
    }
    solid_.clear();
}

void View::paint(int row, const RowRays& rays, const LightRow& out) {
    for (const Seen& seen : seen_)
        if (row >= seen.object->box().top && row <= seen.object->box().bottom) seen.object->paint(rays, out);
}

void View::paint(int row, const RowRays& rays, const Eigen::Isometry3d& T_WC_row, const LightRow& out) {
    const Eigen::Matrix3d R_WC = T_WC_.linear();
    const Matrix3f turn = (R_WC.transpose() * T_WC_row.linear()).cast<float>();
    const Vector3f shift = (R_WC.transpose() * (T_WC_row.translation() - T_WC_.translation())).cast<float>();
    for (const Seen& seen : seen_) {
        const PixelBox& box = seen.object->box();
        if (row < box.top || row > box.bottom) continue;
        // The row's ray t·d from `shift` meets the plane where m·(shift + t·turn·d) = 1.
        const float clear = 1.0F - seen.plane.dot(shift);
        if (!(clear > 0.0F)) continue;
        const Matrix3f H = turn + shift / clear * (seen.plane.transpose() * turn);
        turn_rays(H, rays, box.left, box.right, x_.data(), y_.data());
        // Moved by so little, evenly spaced rays stay as good as evenly spaced.
        seen.object->paint({x_.data(), y_.data(), rays.straight}, out);
    }
}

}  // namespace goalmouth
