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

void View::begin_row(int row, const RowRays& rays, const Eigen::Isometry3d* T_WC_row) {
    rays_ = rays;
    turned_ = T_WC_row != nullptr;
    crossings_.clear();
    Matrix3f turn = Matrix3f::Identity();
    Vector3f shift = Vector3f::Zero();
    if (turned_) {
        const Eigen::Matrix3d R_CW = T_WC_.linear().transpose();
        turn = (R_CW * T_WC_row->linear()).cast<float>();
        shift = (R_CW * (T_WC_row->translation() - T_WC_.translation())).cast<float>();
    }
    for (const Seen& seen : seen_) {
        const PixelBox& box = seen.object->box();
        if (row < box.top || row > box.bottom) continue;
        Crossing crossing{&seen, {0, -1}, {0, -1}, turn};
        if (turned_) {
            // The row's ray t·d from `shift` meets the plane where m·(shift + t·turn·d) = 1.
            const float clear = 1.0F - seen.plane.dot(shift);
            if (!(clear > 0.0F)) continue;
            crossing.turn += shift / clear * (seen.plane.transpose() * turn);
            if (rays.straight) {
                this->turn(crossing.turn, box.left, box.left);
                this->turn(crossing.turn, box.right, box.right);
            } else {
                this->turn(crossing.turn, box.left, box.right);
            }
        }
        const RowRays seen_rays = turned_ ? RowRays{x_.data(), y_.data(), rays.straight} : rays;
        crossing.columns = seen.object->columns(seen_rays);
        if (crossing.columns.first > crossing.columns.last) continue;
        crossing.filled = seen.object->filled(seen_rays);
        crossings_.push_back(crossing);
    }
    find_uncovered();
}

void View::turn(const Matrix3f& H, int first, int last) {
    turn_rays(H, rays_, first, last, x_.data(), y_.data());
}

void View::find_uncovered() {
    filled_.clear();
    for (const Crossing& crossing : crossings_)
        if (crossing.filled.first <= crossing.filled.last) filled_.push_back(crossing.filled);
    std::sort(filled_.begin(), filled_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    uncovered_.clear();
    int next = 0;
    const int end = static_cast<int>(x_.size());
    for (const auto& filled : filled_) {
        if (filled.first > next) uncovered_.push_back({next, filled.first - 1});
        next = std::max(next, filled.last + 1);
    }
    if (next < end) uncovered_.push_back({next, end - 1});
}

void View::paint(const LightRow& out) {
    for (auto crossing = crossings_.begin(); crossing != crossings_.end(); ++crossing) {
        const SeenObject::Columns& columns = crossing->columns;
        const bool hidden = std::any_of(crossing + 1, crossings_.end(), [&](const Crossing& nearer) {
            return nearer.filled.first <= columns.first && nearer.filled.last >= columns.last;
        });
        if (hidden) continue;
        if (!turned_) {
            crossing->seen->object->paint(rays_, columns, out);
            continue;
        }
        // Moved by so little, evenly spaced rays stay as good as evenly spaced.
        turn(crossing->turn, columns.first, columns.last);
        crossing->seen->object->paint(RowRays{x_.data(), y_.data(), rays_.straight}, columns, out);
    }
}

}  // namespace goalmouth
