#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace goalmouth::bench {

/// Copies of each frame between the source and the memory segmentation reads, by what the camera module
/// counts in its STATUS since its start; −1 where it counts nothing.
double copies_per_frame(const std::map<std::string, double>& camera_counters);

/// A counter over frames; −1 where it was not counted or there were none.
double per_frame(const std::map<std::string, double>& counters, const std::string& name, std::int64_t frames);

}  // namespace goalmouth::bench
