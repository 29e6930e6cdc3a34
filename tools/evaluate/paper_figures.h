#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_summary.h"
#include "tools/evaluate/report/figure.h"

#include <cstddef>

namespace goalmouth {

// Figures for one detector in one scene, the first two of them the paper's: one series for each tilt over the
// six distances.
// Curves that lie on each other would hide each other: the tilts stand a little to the left of the distance,
// at it and a little to the right; estimated distances are moved up and down by as much, along the diagonal.

inline constexpr double tilt_dodge_cm = 10.0;
inline constexpr const char* dodge_words =
    "Where tilts would hide each other, 0° is drawn 10 cm nearer and 20° 10 cm farther than it is, on both "
    "axes "
    "of distance.";

/// Share of posts found, in percent.
Figure detection_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                        std::size_t scene);

/// Mean estimated distance ± its standard deviation, over the true one.
Figure distance_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                       std::size_t scene);

/// RMSE of the distance and its bound, on a logarithmic axis, over the true distance.
Figure bound_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                    std::size_t scene);

}  // namespace goalmouth
