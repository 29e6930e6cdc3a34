#pragma once

#include "core/refinement/edge_rows.h"

#include <array>
#include <vector>

namespace goalmouth {

/// Decides which rows of an edge count in a fit, each row of each side on its own.
///
/// Of a row as measured last (measure_row): Tukey's biweight of its offset against the common fit, in sigmas
/// of what all rows' offsets show; 0 where its pixels are not those of one step: where its misfit, or that of
/// the five rows about it, is beyond what their noise explains. That noise is read from the third of the rows
/// that fit best: fewer than that are never clean.
class RowGate {
  public:
    /// Sets the rows' weights and, per side, the variance of the values (`noise`, about 1). `gate`: misfits
    /// count; while the blur is not known they say nothing.
    void weigh(std::array<std::vector<EdgeRow>, 2>& rows, std::array<double, 2>& noise, bool gate);

  private:
    std::vector<float> sorted_;
    std::array<double, 2> freedom_ = {1.0, 1.0};  // of a row's misfit, on either side, on average
};

}  // namespace goalmouth
