#pragma once

#include <cstdint>

namespace goalmouth {

/// When a simulated camera takes its frames: at start + k / rate, k = 0, 1, 2 …, to the microsecond and
/// without drift.
class FrameClock {
  public:
    FrameClock(std::int64_t start_utime, double frames_per_second)
        : start_(start_utime), frames_per_second_(frames_per_second) {}

    /// [µs] of time number k.
    std::int64_t utime(std::int64_t k) const;
    /// [s] since the start of time number k.
    double seconds(std::int64_t k) const { return static_cast<double>(k) / frames_per_second_; }
    /// Number of the last time that has come at `now` [µs]; −1 before the start.
    std::int64_t latest(std::int64_t now) const;

  private:
    std::int64_t start_;
    double frames_per_second_;
};

}  // namespace goalmouth
