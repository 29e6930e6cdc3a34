#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace goalmouth::bench {

/// The value that `share` (0…1) of the ascending values do not exceed, between the two nearest of them. Not
/// for none. The one definition for every figure of the benchmark.
inline double quantile(const std::vector<double>& ascending, double share) {
    const double place = share * static_cast<double>(ascending.size() - 1);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, ascending.size() - 1);
    return std::lerp(ascending[low], ascending[high], place - static_cast<double>(low));
}

}  // namespace goalmouth::bench
