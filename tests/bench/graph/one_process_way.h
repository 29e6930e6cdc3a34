#pragma once

#include "tests/bench/graph/process_way.h"

#include <optional>

namespace goalmouth::bench {

/// The modules of the graph in this thread, on a bus in memory, at the camera's pace for `seconds`. Nothing
/// where it was stopped. Throws ConfigurationError.
std::optional<WayResult> run_in_one_process(double seconds, const GraphBenchOptions& options,
                                            const KeepGoing& keep_going);

}  // namespace goalmouth::bench
