#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_summary.h"
#include "tools/evaluate/report/figure.h"

#include <cstddef>

namespace goalmouth {

// The paper's two figures for one detector in one scene: one series for each tilt over the six distances.

/// Share of posts found, in percent.
Figure detection_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                        std::size_t scene);

/// Mean estimated distance ± its standard deviation, over the true one.
Figure distance_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                       std::size_t scene);

}  // namespace goalmouth
