#include "tests/bench/contender.h"

#include "tests/bench/graph/quantile.h"

#include <algorithm>
#include <ctime>
#include <numeric>
#include <utility>

namespace goalmouth::bench {
namespace {

double now_ms(StopwatchClock clock) {
    timespec now{};
    ::clock_gettime(clock == StopwatchClock::wall ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Timing timing_of(std::string name, std::string label, std::vector<double> ms) {
    std::sort(ms.begin(), ms.end());
    Timing timing;
    timing.name = std::move(name);
    timing.label = std::move(label);
    timing.count = ms.size();
    timing.median = quantile(ms, 0.5);
    timing.p25 = quantile(ms, 0.25);
    timing.p75 = quantile(ms, 0.75);
    timing.p95 = quantile(ms, 0.95);
    timing.least = ms.front();
    timing.mean = std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
    return timing;
}

Stopwatch::Stopwatch(StopwatchClock clock) : clock_(clock), last_(now_ms(clock)) {}

double Stopwatch::lap() {
    const double now = now_ms(clock_);
    return now - std::exchange(last_, now);
}

}  // namespace goalmouth::bench
