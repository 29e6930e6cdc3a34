#pragma once

#include "core/localisation/belief.h"

#include <goalmouth/pose_hypothesis_t.hpp>
#include <goalmouth/pose_t.hpp>

namespace goalmouth {

pose_hypothesis_t to_message(const PoseHypothesis& hypothesis);
PoseHypothesis from_message(const pose_hypothesis_t& message);

pose_t to_message(const PoseEstimate& estimate);
PoseEstimate from_message(const pose_t& message);

}  // namespace goalmouth
