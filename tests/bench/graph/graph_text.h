#pragma once

#include "tests/bench/graph_bench.h"

#include <filesystem>
#include <string>

namespace goalmouth::bench {

/// Where the frames come from.
enum class Pixels {
    ring,      // the camera process, by shared memory
    messages,  // somebody outside the graph, in messages on IMAGE_TAP
};

/// The graph under test as a graph file: camera (for Pixels::ring), segmentation with scan-lines every 8 px,
/// extraction, detection by RANSAC, localisation.
std::string graph_text(const GraphBenchOptions& options, Pixels pixels);

/// The graph file in a folder of its own, removed with it.
class GraphFileOnDisk {
  public:
    explicit GraphFileOnDisk(const std::string& text);
    ~GraphFileOnDisk();
    GraphFileOnDisk(const GraphFileOnDisk&) = delete;
    GraphFileOnDisk& operator=(const GraphFileOnDisk&) = delete;
    std::filesystem::path path() const { return folder_ / "bench.yaml"; }

  private:
    std::filesystem::path folder_;
};

}  // namespace goalmouth::bench
