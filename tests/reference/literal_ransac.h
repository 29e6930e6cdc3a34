#pragma once

#include "core/detection/edge_lines.h"
#include "core/detection/primitive_ransac.h"
#include "core/geometry/line.h"
#include "core/random/random.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// find_lines() by the paper's Algorithm 2 as it is written: every hypothesis measured against every point,
/// one after the other. What the fast search must agree with bit for bit, and what it is timed against.
std::vector<EdgeLine> find_lines_literally(const std::vector<Eigen::Vector2d>& points,
                                           const RansacParameters& parameters, Random& random);

}  // namespace goalmouth
