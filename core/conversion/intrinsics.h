#pragma once

#include "core/geometry/camera.h"

#include <goalmouth/intrinsics_t.hpp>

namespace goalmouth {

intrinsics_t to_message(const Intrinsics& camera);
Intrinsics from_message(const intrinsics_t& message);

}  // namespace goalmouth
