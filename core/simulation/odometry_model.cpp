#include "core/simulation/odometry_model.h"

#include <cmath>

namespace goalmouth {

OdometryModel::OdometryModel(const OdometryParameters& parameters, Random run)
    : parameters_(parameters), random_(run) {
    length_scale_ = parameters.constant_share * parameters.translation_noise * random_.normal();
    turn_scale_ = parameters.constant_share * parameters.rotation_noise * random_.normal();
    draw_slip();
}

void OdometryModel::draw_slip() {
    const double share = std::sqrt(1.0 - parameters_.constant_share * parameters_.constant_share);
    length_slip_ = share * parameters_.translation_noise * random_.normal();
    side_slip_ = parameters_.translation_noise * random_.normal();
    turn_slip_ = share * parameters_.rotation_noise * random_.normal();
    heading_slip_ = parameters_.heading_slip * random_.normal();
}

void OdometryModel::move(const Pose2& motion, std::int64_t footstep) {
    for (; footstep_ < footstep; ++footstep_) draw_slip();
    const double distance = std::hypot(motion.x, motion.y);
    const double longer = 1.0 + length_scale_ + length_slip_;
    pose_ =
        compose(pose_, {longer * motion.x - side_slip_ * motion.y, longer * motion.y + side_slip_ * motion.x,
                        (1.0 + turn_scale_ + turn_slip_) * motion.theta + heading_slip_ * distance});
}

}  // namespace goalmouth
