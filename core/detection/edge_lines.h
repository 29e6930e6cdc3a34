#pragma once

#include "core/detection/ransac_parameters.h"
#include "core/geometry/line.h"
#include "core/random/random.h"

#include <span>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// One side of something: a fitted line with the stretch of it that edge points support.
struct EdgeLine {
    LineSegment segment;  // between the feet of the extreme points of the consensus set
    int support = 0;      // points of the consensus set (n₁, n₂ of the pairing)
    double rms = 0.0;     // px, of the points' distances from the line
};

/// Requires a point.
EdgeLine edge_line(const Line& line, std::span<const Eigen::Vector2d> consensus);

/// Up to M_max lines among edge points; each is the best supported one found among the points the former
/// left. A LineSearch (line_search.h) used once.
std::vector<EdgeLine> find_lines(const std::vector<Eigen::Vector2d>& points,
                                 const RansacParameters& parameters, Random& random);

}  // namespace goalmouth
