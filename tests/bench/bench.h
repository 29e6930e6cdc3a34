#pragma once

#include "tools/goalmouth/bench_options.h"

namespace goalmouth::bench {

/// The whole of `goalmouth bench`: measures, prints, writes. The exit code. Throws ConfigurationError for
/// what the user can mend.
int run_bench(const BenchOptions& options);

}  // namespace goalmouth::bench
