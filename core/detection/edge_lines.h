#pragma once

#include "core/geometry/line.h"

#include <span>

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
EdgeLine edge_line(const Line& line, const PointColumns& consensus);

}  // namespace goalmouth
