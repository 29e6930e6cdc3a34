#include "core/geometry/line.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace goalmouth {

double Line::distance(const Eigen::Vector2d& p) const {
    return std::abs(signed_distance(p));
}

std::optional<double> Line::x_at(double y) const {
    if (std::abs(normal.x()) < 1e-12) return std::nullopt;
    return (offset - normal.y() * y) / normal.x();
}

Line line_with_normal(const Eigen::Vector2d& normal, const Eigen::Vector2d& p) {
    Line line;
    line.normal = normal.normalized();
    if (line.normal.x() < 0.0 || (line.normal.x() == 0.0 && line.normal.y() < 0.0))
        line.normal = -line.normal;
    line.offset = line.normal.dot(p);
    return line;
}

std::optional<Line> line_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d along = b - a;
    if (along.squaredNorm() == 0.0) return std::nullopt;
    return line_with_normal({along.y(), -along.x()}, a);
}

namespace {

template <class Points>
std::optional<Line> fit(const Points& points) {
    if (points.size() < 2) return std::nullopt;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) mean += points[i];
    mean /= static_cast<double>(points.size());

    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d q = points[i] - mean;
        xx += q.x() * q.x();
        xy += q.x() * q.y();
        yy += q.y() * q.y();
    }
    // The scatter's axes differ by the hypotenuse, mostly by far more than the rounding of the coordinates'
    // squares, which is about 1e-16 of them.
    const double rounding = 1e-13 * (mean.squaredNorm() + 1.0) * static_cast<double>(points.size());
    const double spread = std::max(std::abs(xx - yy), std::abs(2.0 * xy));
    if (!(spread > 2.0 * rounding) && std::hypot(xx - yy, 2.0 * xy) <= rounding) return std::nullopt;

    // Direction of the larger eigenvector of the scatter matrix.
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    return line_with_normal({-std::sin(angle), std::cos(angle)}, mean);
}

template <class Points>
LineSegment segment(const Line& line, const Points& points) {
    assert(points.size() > 0);
    const Eigen::Vector2d along = line.direction();
    // Four at once, so that a point need not wait for the one before it.
    std::array<double, 4> firsts;
    firsts.fill(along.dot(points[0]));
    std::array<double, 4> lasts = firsts;
    std::size_t i = 0;
    for (; i + firsts.size() <= points.size(); i += firsts.size()) {
        for (std::size_t j = 0; j < firsts.size(); ++j) {
            const double s = along.dot(points[i + j]);
            firsts[j] = std::min(firsts[j], s);
            lasts[j] = std::max(lasts[j], s);
        }
    }
    for (; i < points.size(); ++i) {
        const double s = along.dot(points[i]);
        firsts[0] = std::min(firsts[0], s);
        lasts[0] = std::max(lasts[0], s);
    }
    const double first = *std::min_element(firsts.begin(), firsts.end());
    const double last = *std::max_element(lasts.begin(), lasts.end());
    const Eigen::Vector2d a = line.offset * line.normal + first * along;
    const Eigen::Vector2d b = line.offset * line.normal + last * along;
    // direction() runs down the image except for a horizontal line, where it runs to −x.
    if (along.y() <= 0.0) return {line, b, a};
    return {line, a, b};
}

}  // namespace

std::optional<Line> fit_line(std::span<const Eigen::Vector2d> points) {
    return fit(points);
}

std::optional<Line> fit_line(const PointColumns& points) {
    return fit(points);
}

double acute_angle(const Line& a, const Line& b) {
    const double sine = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
    return std::atan2(std::abs(sine), std::abs(a.normal.dot(b.normal)));
}

LineSegment segment_on_line(const Line& line, std::span<const Eigen::Vector2d> points) {
    return segment(line, points);
}

LineSegment segment_on_line(const Line& line, const PointColumns& points) {
    return segment(line, points);
}

std::optional<Eigen::Vector2d> intersection(const Line& a, const Line& b) {
    const double determinant = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
    if (std::abs(determinant) < 1e-12) return std::nullopt;
    return Eigen::Vector2d((a.offset * b.normal.y() - b.offset * a.normal.y()) / determinant,
                           (b.offset * a.normal.x() - a.offset * b.normal.x()) / determinant);
}

}  // namespace goalmouth
