#pragma once

#include "tests/bench/summary.h"

#include <filesystem>

namespace goalmouth::bench {

/// One HTML page with tables and figures, and the figures as files of their own (SVG and PNG), in a folder.
/// Throws ConfigurationError.
void write_bench_report(const BenchResult& result, const std::filesystem::path& target);

}  // namespace goalmouth::bench
