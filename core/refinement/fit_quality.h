#pragma once

#include "core/refinement/coarse_edges.h"
#include "core/refinement/edge_rivals.h"
#include "core/refinement/silhouette_fit.h"

#include <array>

namespace goalmouth {

/// How far a fit may be trusted, 0…1: the least of what each thing that can go wrong leaves.
///
/// Rows    of either edge, how many agree: three tenths of those in which the background differs, a number
///         that can be trusted, and some of all rows. What more rows are worth the covariance tells, and
///         whether the others speak for another place does Place;
/// Rival   how well crossings agree with another edge parallel to one of them (CoarseEdge::rival);
/// Place   how much more evidence either edge's place has than the next best (EdgeConsensus);
/// Ends    in how many rows the post's colour ends elsewhere than at either edge and it cannot be told which
/// is right, against those where it ends there;
/// Width   the relative sigma of the distance. 0 where the fit has not converged. `rows`: in which
/// edges were looked for.
double fit_quality(const SilhouetteFit& fit, const CoarseEdgeFinder::Edges& coarse,
                   const std::array<bool, 2>& edges, int rows, const std::array<RivalVerdict, 2>& rivals);

}  // namespace goalmouth
