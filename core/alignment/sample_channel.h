#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <iterator>
#include <optional>

namespace goalmouth {

/// b − a in seconds, whatever the numbers [µs] are.
inline double seconds_between(std::int64_t a, std::int64_t b) {
    return (static_cast<double>(b) - static_cast<double>(a)) * 1e-6;
}

/// What came on one channel, ordered by the time in the data.
template <class Sample>
struct SampleChannel {
    std::deque<Sample> samples;          // ascending utime
    std::optional<std::int64_t> latest;  // utime; samples may have been let go since
    bool awaited = true;

    /// Nothing at this time or later has come yet.
    bool is_next(std::int64_t utime) const { return !latest || utime > *latest; }
    /// Time runs back by more than `by` [s].
    bool runs_back(std::int64_t utime, double by) const {
        return latest && seconds_between(utime, *latest) > by;
    }
};

/// The samples around a time: the last at or before it, and the first at or after it.
template <class Sample>
struct Around {
    const Sample* before = nullptr;
    const Sample* after = nullptr;
};

template <class Sample>
Around<Sample> around(const std::deque<Sample>& samples, std::int64_t utime) {
    const auto next = std::lower_bound(samples.begin(), samples.end(), utime,
                                       [](const Sample& s, std::int64_t t) { return s.utime < t; });
    Around<Sample> result;
    if (next != samples.end()) result.after = &*next;
    if (next != samples.end() && next->utime == utime) {
        result.before = &*next;
    } else if (next != samples.begin()) {
        result.before = &*std::prev(next);
    }
    return result;
}

/// The nearer one, at most `within` [s] away; the earlier of two as near.
template <class Sample>
const Sample* nearest(const Around<Sample>& near, std::int64_t utime, double within) {
    const Sample* best = nullptr;
    double distance = within;
    for (const Sample* s : {near.before, near.after}) {
        if (s == nullptr || std::abs(seconds_between(s->utime, utime)) > distance) continue;
        if (best != nullptr && std::abs(seconds_between(s->utime, utime)) == distance) continue;
        best = s;
        distance = std::abs(seconds_between(s->utime, utime));
    }
    return best;
}

}  // namespace goalmouth
