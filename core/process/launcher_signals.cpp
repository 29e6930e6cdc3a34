#include "core/process/launcher.h"

#include <array>
#include <csignal>

namespace goalmouth {
namespace {

constexpr std::array<int, 3> asking = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t count = 0;
std::array<struct sigaction, asking.size()> former{};

void count_it(int) {
    count = count + 1;
}

}  // namespace

StopSignals::StopSignals() {
    count = 0;
    struct sigaction action {};
    action.sa_handler = count_it;  // without SA_RESTART: what waits returns at once
    for (std::size_t i = 0; i < asking.size(); ++i) sigaction(asking[i], &action, &former[i]);
}

StopSignals::~StopSignals() {
    for (std::size_t i = 0; i < asking.size(); ++i) sigaction(asking[i], &former[i], nullptr);
}

int StopSignals::received() {
    return count;
}

}  // namespace goalmouth
