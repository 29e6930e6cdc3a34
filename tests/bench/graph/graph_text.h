#pragma once

#include "tests/bench/graph_bench.h"
#include "tools/goalmouth/temporary_folder.h"

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

/// Where the graph finds them: what the options name, or what is in config/.
std::filesystem::path field_file(const GraphBenchOptions& options);
std::filesystem::path colours_file(const GraphBenchOptions& options);
std::filesystem::path camera_file(const GraphBenchOptions& options);

/// The graph file in a folder of its own, removed with it.
class GraphFileOnDisk {
  public:
    explicit GraphFileOnDisk(const std::string& text);
    std::filesystem::path path() const { return folder_.path() / "bench.yaml"; }

  private:
    TemporaryFolder folder_;
};

}  // namespace goalmouth::bench
