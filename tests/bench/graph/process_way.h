#pragma once

#include "tests/bench/graph/graph_text.h"

#include <functional>
#include <optional>
#include <string>

namespace goalmouth::bench {

/// Called now and then with the seconds measured so far; false: stop.
using KeepGoing = std::function<bool(double seconds)>;

struct ProcessWay {
    std::string key;
    std::string title;
    Pixels pixels = Pixels::ring;
    std::string lcm_url;
    double seconds = 0.0;    // to measure
    int receive_buffer = 0;  // bytes the kernel grants each receiving socket
    std::string note = {};
};

/// Runs the graph's real processes at the camera's pace and measures, once every process has reported and a
/// moment has passed. Nothing where it was stopped. Throws ConfigurationError where a process cannot run,
/// std::runtime_error where one dies.
std::optional<WayResult> run_processes(const ProcessWay& way, const GraphBenchOptions& options,
                                       const KeepGoing& keep_going);

}  // namespace goalmouth::bench
