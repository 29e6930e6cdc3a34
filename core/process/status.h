#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace goalmouth {

class Bus;

/// What a module counts about itself; published as status_t by whoever runs the module. Message counts come
/// from the bus.
class Status {
  public:
    /// The main output for the frame captured at `utime` was published: gives rate and latency.
    void output(std::int64_t utime);
    /// Frames left out because newer ones were there, or because they were overwritten or lost.
    void dropped(std::int64_t frames) { dropped_ += frames; }
    /// Anything else worth a number; names are lower_case_with_underscores.
    void count(const std::string& name, double amount = 1.0) { counters_[name] += amount; }
    void set(const std::string& name, double value) { counters_[name] = value; }

    std::int64_t outputs() const { return outputs_; }
    std::int64_t dropped_frames() const { return dropped_; }
    const std::map<std::string, double>& counters() const { return counters_; }

    /// Publishes a status_t about the time since the last report. `state` as in status_t.
    void report(Bus& bus, const std::string& channel, const std::string& process,
                const std::string& executable, std::int8_t state);

  private:
    std::int64_t outputs_ = 0;
    std::int64_t dropped_ = 0;
    std::map<std::string, double> counters_;
    std::vector<double> latencies_;  // s, since the last report
    std::int64_t last_report_utime_ = 0;
    double last_cpu_seconds_ = 0.0;
};

}  // namespace goalmouth
