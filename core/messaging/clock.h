#pragma once

#include <cstdint>

namespace goalmouth {

/// Microseconds since 1970-01-01 UTC, now. Only sources of data (capture time) and STATUS (latency) may ask.
std::int64_t now_utime();

}  // namespace goalmouth
