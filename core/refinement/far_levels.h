#pragma once

#include "core/refinement/edge_rows.h"

namespace goalmouth {

/// How much the pixels beyond the rows' windows say about their levels: sets EdgeRows::far_inner_weight and
/// far_outer_weight from the pairs read (EdgeRows::far_inner_pairs, far_outer_pairs).
///
/// Of n pairs that differ from those within the window, in the rows about it, by D² more than noise explains,
/// the mean tells the level with the variance noise/n + D². What they differ by in all rows alike does not
/// grow less with more rows: it counts as many times as there are rows. `noise`: variance of the values.
void judge_far_levels(EdgeRows& rows, float noise);

}  // namespace goalmouth
