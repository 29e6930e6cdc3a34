#include "core/detection/histogram.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

std::size_t Histogram::bin(double x) const {
    const double n = std::floor(x / bin_width);
    return static_cast<std::size_t>(std::clamp(n, 0.0, static_cast<double>(counts.size() - 1)));
}

std::vector<CandidateSegment> without_outsized(const std::vector<CandidateSegment>& segments, double limit) {
    if (segments.empty() || limit <= 0.0) return segments;
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& s : segments) {
        sum += s.length();
        squares += static_cast<double>(s.length()) * s.length();
    }
    const double count = static_cast<double>(segments.size());
    const double mean = sum / count;
    const double deviation = std::sqrt(std::max(0.0, squares / count - mean * mean));
    std::vector<CandidateSegment> kept;
    std::copy_if(segments.begin(), segments.end(), std::back_inserter(kept),
                 [&](const CandidateSegment& s) { return s.length() <= std::max(limit * deviation, mean); });
    return kept;
}

Histogram build_histogram(const std::vector<CandidateSegment>& segments, int image_width, int bins) {
    Histogram histogram;
    histogram.bin_width = static_cast<double>(image_width) / bins;
    histogram.counts.assign(static_cast<std::size_t>(bins), 0.0);
    for (const auto& s : segments) histogram.counts[histogram.bin(s.centre().x())] += s.length();
    return histogram;
}

std::vector<PeakGroup> group_peaks(const std::vector<double>& counts, double threshold) {
    std::vector<PeakGroup> groups;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] < threshold) continue;
        std::size_t j = i;
        while (j + 1 < counts.size() && counts[j + 1] >= threshold) ++j;
        groups.push_back({i, j});
        i = j;
    }
    return groups;
}

}  // namespace goalmouth
