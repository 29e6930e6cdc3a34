#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/step_profile.h"

#include <vector>

namespace goalmouth {

/// What rows say about the blur, summed up: normal equations for σ and the digital share (StepProfile), the
/// row's own offset eliminated.
struct BlurEvidence {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
};

/// Measures where an edge lies in a row: one Gauss–Newton step from `edge` [px].
///
/// The values are modelled as
///     m(x) = a + (b − a)·E(x − t),
/// x [px] outwards from `edge`, E the blurred step, a and b the levels inside and outside. Unknown are the
/// offset t and both levels; the levels have what the neighbouring rows say as prior (EdgeLevel). They are
/// eliminated: `information` is what is left for t,
///     I = N_tt − N_tl (N_ll + P)⁻¹ N_lt,
/// for `noise` as the values' variance. `width` [px]: to the other edge, whose own blur reaches into narrow
/// posts; 0: it does not.
void measure_row(EdgeRow& row, const StepProfile& profile, double edge, double outwards, double width,
                 double noise, BlurEvidence* blur);

/// Makes the levels that each row's own pixels show (EdgeRow::own_inner, own_outer) a prior for the rows
/// about it: their mean, with their scatter as variance. Where levels change from row to row, those on one
/// side of the row count alone, whichever it belongs to.
class LevelSmoother {
  public:
    void smooth(std::vector<EdgeRow>& rows, double noise);

  private:
    struct Sums {
        double weight = 0.0, value = 0.0, square = 0.0, count = 0.0;
    };
    EdgeLevel level(std::size_t row, std::size_t reach, const OwnLevel& own, double noise) const;
    void add_up(const std::vector<EdgeRow>& rows, OwnLevel EdgeRow::*own);

    std::vector<Sums> sums_;  // over all rows before
};

}  // namespace goalmouth
