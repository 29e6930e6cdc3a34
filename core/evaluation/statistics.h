#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace goalmouth {

/// Percentile of a sample: with its n values in order, the one at place share · (n − 1), counted from 0, and
/// between two places their straight mixture. Nothing for an empty sample.
std::optional<double> percentile(std::span<const double> sample, double share);

/// What a sample of errors says, in the errors' unit. Sums run in the order of the sample, so that the same
/// errors in the same order give the same bits.
struct ErrorStatistics {
    double rmse = 0.0;        // root of the mean square: bias² + σ²
    double bias = 0.0;        // mean
    double sigma = 0.0;       // standard deviation about the mean, over n
    double median_abs = 0.0;  // of the absolute values
    double p95_abs = 0.0;     // 95th percentile of the absolute values
};

/// Nothing for an empty sample. Every error must be finite.
std::optional<ErrorStatistics> error_statistics(std::span<const double> errors);

}  // namespace goalmouth
