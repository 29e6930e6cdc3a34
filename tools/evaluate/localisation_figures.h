#pragma once

#include "tools/evaluate/localisation_data.h"
#include "tools/evaluate/report/figure.h"

#include <cstddef>

namespace goalmouth {

/// The walk as it was and as one detector's localisation saw it, run by run.
Figure paths_figure(const LocalisationResult& result, std::size_t detector);

/// Error over time, mean over runs ± σ, and the filter's own σ.
Figure position_over_time(const LocalisationResult& result);
Figure heading_over_time(const LocalisationResult& result);

/// Heading over position error in the last second, a point for each run.
Figure ends_figure(const LocalisationResult& result);

/// Share of the runs whose position error in the last second is at most x.
Figure end_distribution_figure(const LocalisationResult& result);

}  // namespace goalmouth
