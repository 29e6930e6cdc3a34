#pragma once

#include "core/refinement/edge_rows.h"

namespace goalmouth {

/// Makes the levels that each row's own pixels show (RowMeasurements::own_inner, own_outer) a prior for the
/// rows about it: their mean, with their scatter as variance. Where levels change from row to row, those on
/// one side of the row count alone, whichever it belongs to. `noise`: variance of the values.
void smooth_levels(EdgeRows& rows, float noise);

}  // namespace goalmouth
