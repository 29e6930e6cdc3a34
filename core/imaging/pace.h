#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace goalmouth {

/// Evenly spaced images: when the k-th (from 0) is due, after the first and as capture time. Each time comes
/// from k alone, so nothing adds up.
class Pace {
  public:
    Pace(double images_per_second, std::int64_t start_utime)
        : images_per_second_(images_per_second), start_utime_(start_utime) {}

    std::chrono::microseconds after_start(std::int64_t k) const {
        return std::chrono::microseconds(std::llround(1e6 * static_cast<double>(k) / images_per_second_));
    }
    std::int64_t utime(std::int64_t k) const { return start_utime_ + after_start(k).count(); }

  private:
    double images_per_second_;
    std::int64_t start_utime_;
};

}  // namespace goalmouth
