#include "core/messaging/bus.h"

#include <fmt/format.h>

#include <spdlog/spdlog.h>

namespace goalmouth {

std::int64_t BusCounters::rejected_total() const {
    std::int64_t total = 0;
    for (const auto& [cause, count] : rejected) total += count;
    return total;
}

void Bus::reject(const std::string& channel, const std::string& cause) {
    if (counters_.rejected[channel + ": " + cause]++ == 0) {
        spdlog::warn(fmt::format("{}: message refused: {} (counted from now on)", channel, cause));
    }
}

}  // namespace goalmouth
