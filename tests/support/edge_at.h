#pragma once

#include <Eigen/Core>

namespace goalmouth::test {

/// Where the line through a and b crosses a row.
inline double x_at(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double row) {
    return a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

}  // namespace goalmouth::test
