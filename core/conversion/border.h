#pragma once

#include "core/extraction/border.h"
#include "core/geometry/camera.h"

#include <cstdint>

#include <goalmouth/border_t.hpp>

namespace goalmouth {

border_t to_message(const FieldBorder& border, std::int64_t utime, std::int64_t seq,
                    const Intrinsics& camera);
FieldBorder from_message(const border_t& message);

}  // namespace goalmouth
