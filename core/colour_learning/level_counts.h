#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace goalmouth {

/// How often each level of a channel was seen.
class LevelCounts {
  public:
    void add(double level) {
        ++counts_[static_cast<std::size_t>(std::clamp(std::lround(level), 0L, 255L))];
        ++all_;
    }
    /// Taken as spread evenly over each level: in the dark a whole level is too coarse.
    double median() const {
        int below = 0;
        std::size_t level = 0;
        while (level < 255 && 2 * (below + counts_[level]) < all_) below += counts_[level++];
        return static_cast<double>(level) - 0.5 + (0.5 * all_ - below) / std::max(1, counts_[level]);
    }

  private:
    std::array<int, 256> counts_{};
    int all_ = 0;
};

}  // namespace goalmouth
