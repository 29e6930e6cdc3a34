#include "core/refinement/post_silhouette.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace goalmouth {

Eigen::Vector3d PostSilhouette::plane(OutlineSide side) const {
    const double sign = side == OutlineSide::left ? 1.0 : -1.0;
    return sign * std::cos(half_angle) * right + std::sin(half_angle) * ahead;
}

Eigen::Matrix<double, 3, 4> PostSilhouette::plane_change(OutlineSide side) const {
    const double sign = side == OutlineSide::left ? 1.0 : -1.0;
    const double c = sign * std::cos(half_angle);
    const double s = std::sin(half_angle);
    Eigen::Matrix<double, 3, 4> change;
    change.col(silhouette_part::swing) = c * ahead - s * right;
    change.col(silhouette_part::roll) = -c * up;
    change.col(silhouette_part::lean) = s * up;
    change.col(silhouette_part::half_angle) = -sign * s * right + sign * c * ahead;
    return change;
}

PostSilhouette PostSilhouette::moved(const SilhouetteStep& step) const {
    const Eigen::Vector3d turn = step[silhouette_part::swing] * up + step[silhouette_part::roll] * ahead +
                                 step[silhouette_part::lean] * right;
    PostSilhouette result;
    result.right = (right + turn.cross(right)).normalized();
    const Eigen::Vector3d along = up + turn.cross(up);
    result.up = (along - along.dot(result.right) * result.right).normalized();
    result.ahead = result.up.cross(result.right);
    result.half_angle = half_angle + step[silhouette_part::half_angle];
    return result;
}

PostSilhouette silhouette_between(const Eigen::Vector3d& left_plane, const Eigen::Vector3d& right_plane,
                                  const Eigen::Vector3d& up) {
    PostSilhouette result;
    result.right = (left_plane.normalized() - right_plane.normalized()).normalized();
    result.up = (up - up.dot(result.right) * result.right).normalized();
    result.ahead = result.up.cross(result.right);
    const double sine = 0.5 * (left_plane.normalized() + right_plane.normalized()).dot(result.ahead);
    result.half_angle = std::asin(std::clamp(sine, -1.0, 1.0));
    return result;
}

}  // namespace goalmouth
