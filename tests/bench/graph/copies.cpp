#include "tests/bench/graph/copies.h"

namespace goalmouth::bench {

double copies_per_frame(const std::map<std::string, double>& camera_counters) {
    const auto counted = [&](const char* name) {
        const auto found = camera_counters.find(name);
        return found == camera_counters.end() ? 0.0 : found->second;
    };
    const double copied = counted("copied_frames");
    const double frames = copied + counted("frames_in_place");
    return frames > 0.0 ? copied / frames : -1.0;
}

double per_frame(const std::map<std::string, double>& counters, const std::string& name,
                 std::int64_t frames) {
    const auto found = counters.find(name);
    return found == counters.end() || frames <= 0 ? -1.0 : found->second / static_cast<double>(frames);
}

}  // namespace goalmouth::bench
