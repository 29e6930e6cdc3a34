#pragma once

#include "core/geometry/camera.h"
#include "core/segmentation/segments.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include <goalmouth/segments_t.hpp>

namespace goalmouth {

/// What every result message of this stack keeps to [bytes]: one datagram, with room for headers.
inline constexpr std::size_t largest_result_message = 60000;

/// A frame whose segments do not fit `limit` bytes (noise) loses whole scan-lines, spread evenly over the
/// frame; their number stands in lines_left_out.
segments_t to_message(const Segments& segments, std::int64_t utime, std::int64_t seq,
                      const Intrinsics& camera, const std::string& table,
                      std::size_t limit = largest_result_message);
Segments from_message(const segments_t& message);

}  // namespace goalmouth
