#include "tests/bench/graph/pacing.h"

#include <ctime>
#include <fstream>
#include <pthread.h>
#include <string>

namespace goalmouth::bench {
namespace {

double seconds_on(clockid_t clock) {
    timespec time{};
    if (clock_gettime(clock, &time) != 0) return 0.0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

void sleep_until(Clock::time_point when) {
    const auto since_boot = when.time_since_epoch();
    const auto whole = std::chrono::floor<std::chrono::seconds>(since_boot);
    const timespec until{static_cast<time_t>(whole.count()),
                         static_cast<long>(std::chrono::nanoseconds(since_boot - whole).count())};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

double thread_cpu_seconds(std::thread& thread) {
    clockid_t clock{};
    return pthread_getcpuclockid(thread.native_handle(), &clock) == 0 ? seconds_on(clock) : 0.0;
}

double own_cpu_seconds() {
    return seconds_on(CLOCK_THREAD_CPUTIME_ID);
}

double process_cpu_seconds(pid_t pid) {
    clockid_t clock{};
    return pid > 0 && clock_getcpuclockid(pid, &clock) == 0 ? seconds_on(clock) : 0.0;
}

double process_memory(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/smaps_rollup");
    for (std::string word; file >> word;) {
        double kib = 0.0;
        if (word == "Pss:" && file >> kib) return kib / 1024.0;
    }
    return 0.0;
}

}  // namespace goalmouth::bench
