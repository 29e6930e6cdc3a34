#pragma once

#include "tests/bench/graph_bench.h"
#include "tests/bench/point_sets.h"
#include "tests/bench/stages.h"
#include "tools/evaluate/report/figure.h"

#include <vector>

namespace goalmouth::bench {

/// Ours over spacing beside the naive version, at one size.
Figure spacing_figure(const SizeResult& size);

/// RANSAC over the number of points.
Figure points_figure(const std::vector<PointRow>& points);

/// Everybody at one size side by side, ours at the spacing that is judged; a logarithmic scale, because they
/// lie a hundredfold apart.
Figure contenders_figure(const SizeResult& size);

/// How old frames are when their posts are heard, way by way, as a distribution; no series where nothing was
/// heard.
Figure latency_figure(const GraphBenchResult& graph);

}  // namespace goalmouth::bench
