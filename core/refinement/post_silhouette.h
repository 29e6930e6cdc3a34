#pragma once

#include <Eigen/Core>

namespace goalmouth {

enum class OutlineSide { left, right };

/// A change of a silhouette [rad]: swing about the post's axis (+ the post moves left), roll about the line
/// of sight to it, lean within the plane through camera and axis, half angle.
using SilhouetteStep = Eigen::Vector4d;
namespace silhouette_part {
inline constexpr int swing = 0, roll = 1, lean = 2, half_angle = 3;
}

/// What a camera sees of an endless post: two planes through its centre that touch a cylinder. Frame C.
///
/// `right`, `up` and `ahead` = up × right are square to each other: up runs along the axis, ahead meets it.
/// With η the half angle the planes' normals, both towards the post, are
///     n_l =  cos η · right + sin η · ahead,   n_r = −cos η · right + sin η · ahead,
/// and the axis of a cylinder of radius r is r / sin η away.
struct PostSilhouette {
    Eigen::Vector3d right = Eigen::Vector3d::UnitX();
    Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
    Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
    double half_angle = 0.0;  // rad, 0 … π/2

    Eigen::Vector3d plane(OutlineSide side) const;
    /// d plane(side) / d step.
    Eigen::Matrix<double, 3, 4> plane_change(OutlineSide side) const;
    /// The silhouette after a small step; exactly orthonormal again.
    PostSilhouette moved(const SilhouetteStep& step) const;
};

/// From the planes' normals, both towards the post, and a direction that is up along the axis but for an
/// error within the middle plane and out of it; only its part in the middle plane counts.
PostSilhouette silhouette_between(const Eigen::Vector3d& left_plane, const Eigen::Vector3d& right_plane,
                                  const Eigen::Vector3d& up);

}  // namespace goalmouth
