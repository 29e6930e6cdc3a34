#pragma once

#include "core/alignment/kinematics.h"

#include <goalmouth/kinematics_t.hpp>

namespace goalmouth {

/// The quaternion is normalised, the covariance made symmetric.
KinematicsSample from_message(const kinematics_t& message);

/// `seq` is that of the frame it was measured for, −1 where for none.
kinematics_t to_message(const KinematicsSample& sample, std::int64_t seq);

}  // namespace goalmouth
