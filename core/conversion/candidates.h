#pragma once

#include "core/conversion/segments.h"
#include "core/extraction/candidates.h"
#include "core/geometry/camera.h"

#include <cstddef>
#include <cstdint>

#include <goalmouth/candidates_t.hpp>

namespace goalmouth {

/// Candidates that do not fit `limit` bytes (noise) are thinned evenly, segments and both edge sets in the
/// same proportion.
candidates_t to_message(const Candidates& candidates, std::int64_t utime, std::int64_t seq,
                        const Intrinsics& camera, std::size_t limit = largest_result_message);
Candidates from_message(const candidates_t& message);

}  // namespace goalmouth
