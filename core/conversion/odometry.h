#pragma once

#include "core/localisation/frame_aligner.h"

#include <goalmouth/odometry_t.hpp>

namespace goalmouth {

OdometrySample from_message(const odometry_t& message);

/// `seq` is the message's own number.
odometry_t to_message(const OdometrySample& sample, std::int64_t seq);

}  // namespace goalmouth
