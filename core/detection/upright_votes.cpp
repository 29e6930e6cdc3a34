#include "core/detection/upright_votes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace goalmouth {

void AzimuthVotes::find(const std::vector<UprightPoint>& points, double roll, double tolerance, int least,
                        std::size_t most, std::vector<AzimuthPeak>& peaks) {
    peaks.clear();
    places_.clear();
    for (const UprightPoint& p : points) places_.push_back(p.ray.azimuth - roll * p.ray.slope);
    std::sort(places_.begin(), places_.end());
    windows_.clear();
    for (std::size_t first = 0, end = 0; first < places_.size(); ++first) {
        const std::size_t end_before = end;
        while (end < places_.size() && places_[end] - places_[first] <= 2.0 * tolerance) ++end;
        const auto count = static_cast<int>(end - first);
        // One that ends where the one before does is a part of it.
        if (count >= least && end > end_before) windows_.push_back({count, first});
    }
    std::sort(windows_.begin(), windows_.end(), [](const Window& a, const Window& b) {
        return a.points != b.points ? a.points > b.points : a.first < b.first;
    });
    for (const Window& w : windows_) {
        if (peaks.size() >= most) break;
        const auto begin = places_.begin() + static_cast<std::ptrdiff_t>(w.first);
        const double mean = std::accumulate(begin, begin + w.points, 0.0) / w.points;
        const bool taken = std::any_of(peaks.begin(), peaks.end(), [&](const AzimuthPeak& p) {
            return std::abs(p.azimuth - mean) < 2.0 * tolerance;
        });
        if (taken) continue;
        const auto from = std::lower_bound(places_.begin(), places_.end(), mean - 2.0 * tolerance);
        const auto to = std::upper_bound(from, places_.end(), mean + 2.0 * tolerance);
        peaks.push_back({mean, w.points, static_cast<int>(to - from)});
    }
}

}  // namespace goalmouth
