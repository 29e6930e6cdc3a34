#include "core/geometry/cylinder.h"

#include <cmath>
#include <utility>

namespace goalmouth {
namespace {

constexpr double nearest_depth = 0.01;  // m

Eigen::Vector2d undistorted_pixel(const Intrinsics& camera, const Eigen::Vector3d& p) {
    return {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
}

/// Cuts the segment a…b at the nearest depth; false where nothing is left.
bool clip_to_front(Eigen::Vector3d& a, Eigen::Vector3d& b) {
    if (a.z() < nearest_depth && b.z() < nearest_depth) return false;
    const auto cut = [](Eigen::Vector3d& behind, const Eigen::Vector3d& front) {
        if (behind.z() >= nearest_depth) return;
        behind += (front - behind) * ((nearest_depth - behind.z()) / (front.z() - behind.z()));
    };
    cut(a, b);
    cut(b, a);
    return true;
}

}  // namespace

std::optional<CylinderSilhouette> silhouette(const Cylinder& cylinder, const Eigen::Isometry3d& T_WC) {
    const Eigen::Vector3d to_base = cylinder.base - T_WC.translation();
    const Eigen::Vector3d to_axis = to_base - to_base.dot(cylinder.axis) * cylinder.axis;
    const double distance = to_axis.norm();
    if (!(distance > cylinder.radius)) return std::nullopt;

    const Eigen::Vector3d ahead = to_axis / distance;
    const Eigen::Vector3d left = cylinder.axis.cross(ahead);
    const double sine = cylinder.radius / distance;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));

    CylinderSilhouette result;
    result.left_contact = -sine * ahead + cosine * left;
    result.right_contact = -sine * ahead - cosine * left;
    const Eigen::Matrix3d R_CW = T_WC.linear().transpose();
    result.left_plane = -(R_CW * result.left_contact);
    result.right_plane = -(R_CW * result.right_contact);
    result.axis_distance = distance;
    result.half_angle = std::asin(sine);
    return result;
}

std::optional<CylinderEdges> project_edges(const Intrinsics& camera, const Eigen::Isometry3d& T_WC,
                                           const Cylinder& cylinder) {
    const auto outline = silhouette(cylinder, T_WC);
    if (!outline) return std::nullopt;
    const Eigen::Isometry3d T_CW = T_WC.inverse();
    const auto ends =
        [&](const Eigen::Vector3d& contact) -> std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> {
        const Eigen::Vector3d offset = cylinder.radius * contact;
        Eigen::Vector3d base = T_CW * (cylinder.base + offset).eval();
        Eigen::Vector3d top = T_CW * (cylinder.top() + offset).eval();
        if (!clip_to_front(base, top)) return std::nullopt;
        return std::pair{undistorted_pixel(camera, base), undistorted_pixel(camera, top)};
    };
    const auto left = ends(outline->left_contact);
    const auto right = ends(outline->right_contact);
    if (!left || !right) return std::nullopt;
    return CylinderEdges{left->first, left->second, right->first, right->second};
}

}  // namespace goalmouth
