#pragma once

#include "tests/bench/graph_bench.h"
#include "tests/bench/machine.h"
#include "tests/bench/ratio.h"
#include "tests/bench/stages.h"
#include "tools/goalmouth/bench_options.h"

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace goalmouth::bench {

/// Everything a run of `goalmouth bench` knows.
struct BenchResult {
    BenchOptions options;
    std::string command;  // the command line that asks for the same once more
    Machine machine;
    std::optional<StagesResult> stages;
    std::optional<GraphBenchResult> graph;

    /// The rows of the acceptance table that this run measured.
    std::vector<Ratio> ratios() const;
};

/// Printed first: machine, SIMD, compiler, sizes.
std::string head_text(const BenchResult& result);
/// What everybody took at one size.
std::string size_text(const SizeResult& size);
/// What refining a post took there.
std::string refinement_text(const SizeResult& size);
/// Who could not take part.
std::string left_out_text(const StagesResult& stages);
/// RANSAC over points.
std::string points_text(const std::vector<PointRow>& points);
/// Ours, other, ratio, bar, stretch, met or not.
std::string ratios_text(const std::vector<Ratio>& ratios);

/// "0.812 ms", or what the row's unit says.
std::string value_text(const Ratio& ratio, double value);
/// What the rows have in common: "1600x1200, scan-lines every 8 px"; "" where nothing.
std::string conditions_text(const std::vector<Ratio>& ratios);
std::string verdict_text(const Ratio& ratio);

nlohmann::ordered_json bench_json(const BenchResult& result);

}  // namespace goalmouth::bench
