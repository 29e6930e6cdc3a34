#include "core/messaging/clock.h"

#include <chrono>

namespace goalmouth {

std::int64_t now_utime() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

}  // namespace goalmouth
