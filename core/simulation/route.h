#pragma once

#include "core/field/field.h"
#include "core/geometry/pose2.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// A smooth endless path on the field by arc length: a lead-in, then a loop. A uniform cubic B-spline, so
/// that heading and curvature never jump; it rounds the corners of its control points.
class Route {
  public:
    /// Starts exactly at `start`, heading for `towards`, then rounds the `lead_in` points and goes about
    /// `loop` for ever (at least three points). Throws std::invalid_argument where start and towards are one
    /// point or the loop has fewer.
    Route(const Eigen::Vector2d& start, const Eigen::Vector2d& towards,
          const std::vector<Eigen::Vector2d>& lead_in, const std::vector<Eigen::Vector2d>& loop);

    /// Pose `distance` ≥ 0 [m] along the path, heading along it.
    Pose2 at(double distance) const;
    double lead_in_length() const { return lead_in_length_; }
    double loop_length() const { return lengths_.back() - lead_in_length_; }

  private:
    Eigen::Vector2d position(std::size_t segment, double u) const;
    Eigen::Vector2d tangent(std::size_t segment, double u) const;

    std::vector<Eigen::Vector2d> points_;
    std::vector<double> lengths_;  // m from the start, at each of `pieces` pieces of each segment
    double lead_in_length_ = 0.0;
};

/// The paper's walk (its section on self-localisation): from the sideline half-way between own goal and
/// centre circle to the penalty mark of that half, passing the ball at a hand's breadth; from there on an
/// eight over the field that faces one goal and then the other.
Route paper_route(const Field& field);

}  // namespace goalmouth
