#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/row_purity.h"
#include "core/refinement/step_profile.h"

#include <array>
#include <vector>

namespace goalmouth {

/// Decides which rows of an edge count in a fit, each row of each side on its own.
///
/// Of a row as measured last (measure_rows): Tukey's biweight of its offset against the common fit, in sigmas
/// of what all rows' offsets show; 0 where its pixels are not those of one step: where its misfit or its
/// strays (a third colour), or those of the five rows about it, are beyond what their noise explains. That
/// noise is read from the third of the rows that fit best: fewer than that are never clean. Where both edges
/// are noisier than the colours themselves the camera made them so; where one is, what lies behind it.
class RowGate {
  public:
    /// Sets the rows' weights and, per side, the variance of the values (`noise`, about 1). `gate`: misfits
    /// count; while the blur is not known they say nothing.
    void weigh(std::array<EdgeRows, 2>& rows, std::array<double, 2>& noise, const StepProfile& profile,
               bool gate);

  private:
    using Rows = std::array<EdgeRows, 2>;
    using Noise = std::array<double, 2>;
    /// The number that a third of the rows that can be judged stay below, of `part(row)`; 0 where there are
    /// none.
    template <class Part>
    double third_of(const EdgeRows& rows, Part part);
    /// Variance of the values that a part of the rows, their misfit or stray, shows on either side.
    template <class Part>
    Noise noise_of(const Rows& rows, Part part);

    /// Light missing inside either edge, as a post's shading and the camera explain it [px of black].
    std::array<double, 2> shading_of(const Rows& rows);

    /// Sigma of that from row to row.
    std::array<double, 2> scatter_of(const Rows& rows, const std::array<double, 2>& shading);

    std::array<LocalRows, 2> local_;
    std::vector<float> chosen_;
    std::array<double, 2> freedom_ = {1.0, 1.0};  // of a row's misfit, on either side, on average
};

}  // namespace goalmouth
