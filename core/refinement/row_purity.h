#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/step_profile.h"

#include <cstddef>

namespace goalmouth {

/// What speaks against rows as those of one step, as measured last: EdgeRows::stray, mean square of the
/// strays for each degree of freedom, a level on either side left out; and EdgeRows::dark, how much light is
/// missing just inside the edge of what the pixels farther in and outside let expect [px of black].
void judge_rows(EdgeRows& rows, const StepProfile& profile, float outwards);

/// The mean over the rows that can be judged of each row and `reach` on either side.
void local_means(const EdgeRows& rows, const RowColumn<float>& part, std::size_t reach,
                 RowColumn<float>& means);

/// From where on a quantity is more than usual, and from where on it is quite another thing's.
struct Unusual {
    float usual = 0.0F, most = 1.0F;
};

/// What RowGate finds usual on one side.
struct UsualRows {
    bool gate = false;            // rows are judged by more than their offset
    float shading = 0.0F;         // px of black
    Unusual dark;                 // of what is missing or too much beside shading, in the mean of rows
    Unusual misfit, stray;        // of a row on its own
    Unusual misfits, strays;      // of the mean of rows
    float least_variance = 0.0F;  // px², of an edge's place in any row
    float farthest = 1.0F;        // sigmas of an offset that counts
};

/// Means over neighbouring rows.
struct LocalRows {
    RowColumn<float> misfit, stray, dark;
};

/// EdgeRows::clean and, of rows that are not outvoted, EdgeRows::weight.
void weigh_rows(const UsualRows& usual, const LocalRows& local, EdgeRows& rows);

/// The nth smallest of some numbers, from 0 on.
float nth_smallest(const float* numbers, std::size_t count, std::size_t n);

}  // namespace goalmouth
