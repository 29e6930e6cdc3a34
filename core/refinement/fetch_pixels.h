#pragma once

#include "core/imaging/yuyv.h"

#include <algorithm>
#include <hwy/cache_control.h>

namespace goalmouth {

/// Asks memory for the pixels of a row between two columns [px], inside the picture or not, and does not wait
/// for them: of many rows all at once, waiting for one row after the other would take longer than working on
/// them.
inline void fetch_pixels(YuyvView image, int row, double from, double to) {
    constexpr int line = 32;  // px of a cache line
    const double most = image.width - 1.0;
    const int first = static_cast<int>(std::min(most, std::max(0.0, from)));  // NaN: 0
    const int last = static_cast<int>(std::min(most, std::max(0.0, to)));
    for (int x = first; x <= last; x += line) hwy::Prefetch(image.row(row) + 2 * x);
    hwy::Prefetch(image.row(row) + 2 * last);
}

}  // namespace goalmouth
