#include "core/evaluation/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace goalmouth {
namespace {

double percentile_of_sorted(std::span<const double> sorted, double share) {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(std::floor(place));
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::optional<double> percentile(std::span<const double> sample, double share) {
    if (sample.empty()) return std::nullopt;
    std::vector<double> sorted(sample.begin(), sample.end());
    std::sort(sorted.begin(), sorted.end());
    return percentile_of_sorted(sorted, share);
}

std::optional<ErrorStatistics> error_statistics(std::span<const double> errors) {
    if (errors.empty()) return std::nullopt;
    const auto count = static_cast<double>(errors.size());
    double sum = 0.0;
    double squares = 0.0;
    std::vector<double> sizes;
    sizes.reserve(errors.size());
    for (const double error : errors) {
        assert(std::isfinite(error));
        sum += error;
        squares += error * error;
        sizes.push_back(std::abs(error));
    }
    std::sort(sizes.begin(), sizes.end());
    ErrorStatistics result;
    result.bias = sum / count;
    result.rmse = std::sqrt(squares / count);
    double spread = 0.0;
    for (const double error : errors) spread += (error - result.bias) * (error - result.bias);
    result.sigma = std::sqrt(spread / count);
    result.median_abs = percentile_of_sorted(sizes, 0.5);
    result.p95_abs = percentile_of_sorted(sizes, 0.95);
    return result;
}

}  // namespace goalmouth
