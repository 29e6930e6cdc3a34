#include "core/imaging/frame_clock.h"

#include <cmath>

namespace goalmouth {

std::chrono::microseconds FrameClock::after_start(std::int64_t k) const {
    return std::chrono::microseconds(std::llround(1e6 * static_cast<double>(k) / frames_per_second_));
}

std::int64_t FrameClock::latest(std::int64_t now) const {
    if (now < start_) return -1;
    auto k =
        static_cast<std::int64_t>(std::floor(static_cast<double>(now - start_) * 1e-6 * frames_per_second_));
    while (utime(k + 1) <= now) ++k;
    while (utime(k) > now) --k;
    return k;
}

}  // namespace goalmouth
