#pragma once

#include <cstdint>

namespace goalmouth {

/// Microseconds since 1970-01-01 UTC, now. Only sources of data (capture time), STATUS (latency) and
/// logs (time of arrival) may ask.
std::int64_t now_utime();

/// A time in seconds since 1970-01-01 UTC, as parameters give it, in microseconds; 0 stands for now.
std::int64_t utime_or_now(double seconds);

}  // namespace goalmouth
