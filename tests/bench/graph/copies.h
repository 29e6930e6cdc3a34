#pragma once

#include "tests/bench/graph_bench.h"

#include <map>
#include <string>

namespace goalmouth::bench {

/// Copies of each frame between the source and the memory segmentation reads, by what the camera module
/// counts in its STATUS since its start; −1 where it counts nothing.
double copies_per_frame(const std::map<std::string, double>& camera_counters);

}  // namespace goalmouth::bench
