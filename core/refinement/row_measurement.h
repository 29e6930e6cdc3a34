#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/step_profile.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// What rows say about the blur, summed up: normal equations for σ and the digital share (StepProfile), the
/// row's own offset eliminated.
struct BlurEvidence {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
};

/// The same of each row.
struct BlurRows {
    RowColumn<float> blur, shared, digital;  // the information's elements
    RowColumn<float> blur_pull, digital_pull;

    void assign(std::size_t rows);
    /// Sum over rows by their weight in the fit.
    BlurEvidence evidence(const EdgeRows& rows) const;
};

/// Where the rows' edges are supposed.
struct SupposedEdges {
    RowColumn<float> start;   // px, of each row's first pair outwards from there
    RowColumn<float> across;  // px to the other edge, whose blur reaches into narrow posts; 0: it does not
};

/// Measures where an edge lies in its rows: one Gauss–Newton step from where it is supposed.
///
/// The values are modelled as
///     m(x) = a + (b − a)·E(x − t),
/// x [px] outwards from the supposed edge, E the blurred step, a and b the levels inside and outside. Unknown
/// are the offset t and both levels; the levels have what the neighbouring rows say as prior
/// (EdgeRows::inner, outer). They are eliminated: `information` is what is left for t,
///     I = N_tt − N_tl (N_ll + P)⁻¹ N_lt,
/// for `noise` as the values' variance; 0 for rows that are not seen. `blocks`: which blocks of rows, where
/// not all; `blur`: what they say of it, where asked.
void measure_rows(const EdgeRows& rows, const StepProfile& profile, const SupposedEdges& edges,
                  float outwards, float noise, const std::vector<bool>* blocks, RowMeasurements& measured,
                  BlurRows* blur);

}  // namespace goalmouth
