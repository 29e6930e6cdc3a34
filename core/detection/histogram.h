#pragma once

#include "core/extraction/candidates.h"

#include <cstddef>
#include <vector>

namespace goalmouth {

/// 1-dimensional histogram of segment lengths over the image's width (paper, section 3).
struct Histogram {
    double bin_width = 0.0;      // px: bin n (from 0) covers [n, n + 1) · bin_width
    std::vector<double> counts;  // px, c^[n]: summed length of the segments whose centre falls into the bin

    /// Bin of a pixel column (equation 1); x in 0 … width − 1.
    std::size_t bin(double x) const;
};

/// Bins first … last are peaks, and so is none beside them.
struct PeakGroup {
    std::size_t first;
    std::size_t last;
};

/// The segments that go into the histogram: those that are not longer than `limit` standard deviations of all
/// segments' lengths. The text compares a length with the standard deviation alone, which leaves nothing of
/// segments that are all alike; so a segment no longer than the mean always stays. limit 0: all stay.
std::vector<CandidateSegment> without_outsized(const std::vector<CandidateSegment>& segments, double limit);

Histogram build_histogram(const std::vector<CandidateSegment>& segments, int image_width, int bins);

/// Algorithm 1: maximal runs of adjacent bins with at least `threshold` (γ) px. Errors in the text, mended by
/// their evident intent: its outer loop ends before bin N, so that a peak in the last bin alone is lost, and
/// does not go on behind a group it has just made, so that the group's rest is added again.
std::vector<PeakGroup> group_peaks(const std::vector<double>& counts, double threshold);

}  // namespace goalmouth
