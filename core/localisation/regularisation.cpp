#include "core/localisation/regularisation.h"

#include <cmath>

namespace goalmouth {

double kernel_share(std::size_t particles) {
    constexpr double d = 3.0;
    const double n = static_cast<double>(particles);
    return std::pow(4.0 / ((d + 2.0) * n), 2.0 / (d + 4.0));
}

FrameObservation widened(const FrameObservation& frame, const PoseHypothesis& belief, double share) {
    FrameObservation result = frame;
    const Eigen::Matrix2d place = share * belief.covariance.topLeftCorner<2, 2>();
    const double turn = share * belief.covariance(2, 2);
    for (PostObservation& z : result.posts) {
        if (!z.refined) continue;
        z.common_azimuth_variance += turn;
        z.covariance(0, 0) += turn;
        if (!z.has_distance) continue;
        // d (azimuth, 1/distance) / d (x, y), towards the post as the belief's heading has it.
        const double direction = belief.pose.theta + z.azimuth;
        const Eigen::Vector2d towards(std::cos(direction), std::sin(direction));
        Eigen::Matrix2d J;
        J.row(0) = z.inverse_distance * Eigen::RowVector2d(towards.y(), -towards.x());
        J.row(1) = z.inverse_distance * z.inverse_distance * towards.transpose();
        z.covariance += J * place * J.transpose();
    }
    return result;
}

}  // namespace goalmouth
