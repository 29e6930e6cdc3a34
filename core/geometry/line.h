#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace goalmouth {

/// Straight line of the image plane in normal form: normal · p = offset [px], |normal| = 1.
///
/// The normal points to +x (to +y where the line is horizontal), so for a line that is not horizontal a
/// positive signed distance means "to the right of it" and direction() runs down the image.
struct Line {
    Eigen::Vector2d normal{1.0, 0.0};
    double offset = 0.0;

    double signed_distance(const Eigen::Vector2d& p) const { return normal.dot(p) - offset; }
    double distance(const Eigen::Vector2d& p) const;
    Eigen::Vector2d direction() const { return {-normal.y(), normal.x()}; }
    Eigen::Vector2d foot(const Eigen::Vector2d& p) const { return p - signed_distance(p) * normal; }
    /// x of the line at height y; nothing for a horizontal line.
    std::optional<double> x_at(double y) const;
};

/// Part of a line between two points of it; `upper` has the smaller y (the smaller x where it is horizontal).
struct LineSegment {
    Line line;
    Eigen::Vector2d upper = Eigen::Vector2d::Zero();
    Eigen::Vector2d lower = Eigen::Vector2d::Zero();

    double length() const { return (lower - upper).norm(); }
    Eigen::Vector2d middle() const { return 0.5 * (upper + lower); }
};

/// The line with this normal (any length but 0, either sense) through p.
Line line_with_normal(const Eigen::Vector2d& normal, const Eigen::Vector2d& p);

/// Nothing where the points are equal.
std::optional<Line> line_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Points as two columns of numbers, as vector instructions want them.
struct PointColumns {
    std::span<const double> x;
    std::span<const double> y;

    std::size_t size() const { return x.size(); }
    Eigen::Vector2d operator[](std::size_t i) const { return {x[i], y[i]}; }
};

/// Total least squares: the line with the least sum of squared distances. Nothing with fewer than two
/// different points, and nothing where no direction is better than another (a square's corners).
std::optional<Line> fit_line(std::span<const Eigen::Vector2d> points);
std::optional<Line> fit_line(const PointColumns& points);

/// Root of the mean square of the points' distances from the line [px]. Requires a point.
double rms_distance(const Line& line, std::span<const Eigen::Vector2d> points);
double rms_distance(const Line& line, const PointColumns& points);

/// Angle between two lines, 0 … π/2 [rad].
double acute_angle(const Line& a, const Line& b);

/// From the first to the last of the points' feet on the line. Requires a point.
LineSegment segment_on_line(const Line& line, std::span<const Eigen::Vector2d> points);
LineSegment segment_on_line(const Line& line, const PointColumns& points);

/// Where two lines meet; nothing where they are parallel to within 1e-12 rad.
std::optional<Eigen::Vector2d> intersection(const Line& a, const Line& b);

}  // namespace goalmouth
