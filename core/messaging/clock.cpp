#include "core/messaging/clock.h"

#include <chrono>
#include <cmath>

namespace goalmouth {

std::int64_t now_utime() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

std::int64_t utime_or_now(double seconds) {
    return seconds > 0.0 ? std::llround(1e6 * seconds) : now_utime();
}

}  // namespace goalmouth
