#include "tools/goalmouth/interrupt.h"

#include <array>
#include <atomic>
#include <csignal>

namespace goalmouth {
namespace {

constexpr std::array<int, 2> signals = {SIGINT, SIGTERM};
std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
std::array<struct sigaction, signals.size()> before{};

}  // namespace

Interrupt::Interrupt() {
    asked = false;
    struct sigaction action {};
    action.sa_handler = [](int) { asked = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before[i]);
}

Interrupt::~Interrupt() {
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before[i], nullptr);
}

bool Interrupt::requested() const {
    return asked;
}

}  // namespace goalmouth
