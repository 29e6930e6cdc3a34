#pragma once

#include <chrono>
#include <cstdint>

namespace goalmouth {

/// When frames that are evenly spaced are taken: at start + k / rate, k = 0, 1, 2 …, to the microsecond. Each
/// time comes from k alone, so nothing adds up.
class FrameClock {
  public:
    /// `start_utime` in µs; `frames_per_second` > 0.
    FrameClock(std::int64_t start_utime, double frames_per_second)
        : start_(start_utime), frames_per_second_(frames_per_second) {}

    /// From time number 0 to time number k.
    std::chrono::microseconds after_start(std::int64_t k) const;
    /// [µs] of time number k.
    std::int64_t utime(std::int64_t k) const { return start_ + after_start(k).count(); }
    /// [s] from time number 0 to time number k, not rounded.
    double seconds(std::int64_t k) const { return static_cast<double>(k) / frames_per_second_; }
    /// Number of the last time that has come at `now` [µs]; −1 before the start.
    std::int64_t latest(std::int64_t now) const;

  private:
    std::int64_t start_;
    double frames_per_second_;
};

}  // namespace goalmouth
