#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/post_silhouette.h"

#include <Eigen/Core>

namespace goalmouth {

/// Puts each row's edge (EdgeRows::edge) where a plane crosses it, the lens linear from where it was read on.
void place_edges(const Eigen::Vector3d& plane, EdgeRows& rows);

/// What rows ask of a step: H s = g.
struct StepEquations {
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();  // H
    SilhouetteStep pull = SilhouetteStep::Zero();           // g
};

/// Adds those rows that count: Σ ω I J Jᵀ and Σ ω I t J, J = −(ray·dn/dstep) / (n·ray') how far [px] the
/// crossing of the plane n moves along the row, t the offset, no more than `most` px of it.
void add_rows(const EdgeRows& rows, const Eigen::Vector3d& plane, const Eigen::Matrix<double, 3, 4>& change,
              double outwards, double most, StepEquations& equations);

}  // namespace goalmouth
