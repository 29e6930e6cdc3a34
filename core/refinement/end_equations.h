#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/normal_table.h"

#include <cstddef>

#include <Eigen/Core>

namespace goalmouth {

/// A blurred step across a post's end.
struct EndStep {
    double place = 0.0, blur = 0.0;   // px
    double inner = 0.0, outer = 0.0;  // levels before and behind it
};

/// Gauss and Newton's equations of a step for its place, the logarithm of its blur and both levels.
struct EndEquations {
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    Eigen::Vector4d pull = Eigen::Vector4d::Zero();
    double squares = 0.0;  // Σ of what the step leaves of the values
};

/// Of so many values at places along the way [px]; both columns hold them from their first on.
EndEquations end_equations(const RowColumn<double>& way, const RowColumn<double>& value, std::size_t count,
                           const EndStep& step, const NormalTable& normal);

}  // namespace goalmouth
