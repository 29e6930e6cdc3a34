#include "core/process/status.h"

#include "core/messaging/clock.h"
#include "core/messaging/typed.h"

#include <algorithm>
#include <sys/resource.h>
#include <unistd.h>

#include <goalmouth/status_t.hpp>

namespace goalmouth {
namespace {

/// Older than this, data comes from a log: its age says nothing about speed.
constexpr double replayed_after_seconds = 10.0;

double seconds_of(const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return -1.0;
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

}  // namespace

void Status::output(std::int64_t utime) {
    ++outputs_;
    const double age = 1e-6 * static_cast<double>(now_utime() - utime);
    latencies_.push_back(age);
}

void Status::report(Bus& bus, const std::string& channel, const std::string& process,
                    const std::string& executable, std::int8_t state) {
    const std::int64_t now = now_utime();
    const double cpu = cpu_seconds();
    const double elapsed =
        last_report_utime_ == 0 ? 0.0 : 1e-6 * static_cast<double>(now - last_report_utime_);

    const BusCounters& traffic = bus.counters();
    status_t m{};
    m.utime = now;
    m.process = process;
    m.executable = executable;
    m.pid = getpid();
    m.state = state;
    m.received = traffic.received;
    m.published = traffic.published;
    m.dropped = dropped_;
    m.rejected = traffic.rejected_total();
    m.rate = elapsed > 0.0 ? static_cast<double>(latencies_.size()) / elapsed : 0.0;
    const double worst = latencies_.empty() ? 0.0 : *std::max_element(latencies_.begin(), latencies_.end());
    const bool live = !latencies_.empty() && worst < replayed_after_seconds &&
                      *std::min_element(latencies_.begin(), latencies_.end()) >= 0.0;
    m.latency_p50 = live ? percentile(latencies_, 0.50) : -1.0;
    m.latency_p99 = live ? percentile(latencies_, 0.99) : -1.0;
    m.busy = elapsed > 0.0 ? std::max(0.0, (cpu - last_cpu_seconds_) / elapsed) : 0.0;
    for (const auto& [name, value] : counters_) {
        counter_t counter{};
        counter.name = name;
        counter.value = value;
        m.counters.push_back(counter);
    }
    if (traffic.oversized > 0) {
        counter_t counter{};
        counter.name = "oversized";
        counter.value = static_cast<double>(traffic.oversized);
        m.counters.push_back(counter);
    }
    m.num_counters = static_cast<std::int32_t>(m.counters.size());

    latencies_.clear();
    last_report_utime_ = now;
    last_cpu_seconds_ = cpu;
    publish(bus, channel, m);
}

}  // namespace goalmouth
