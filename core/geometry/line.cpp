#include "core/geometry/line.h"

#include <algorithm>
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

// Sums and extremes are taken over four points at once, so that one need not wait for the one before it.
using Four = Eigen::Array4d;

struct FourPoints {
    Four x, y;
};

FourPoints four_points(const PointColumns& points, std::size_t i) {
    return {Eigen::Map<const Four>(points.x.data() + i), Eigen::Map<const Four>(points.y.data() + i)};
}

FourPoints four_points(std::span<const Eigen::Vector2d> points, std::size_t i) {
    const Eigen::Vector2d* const p = points.data() + i;
    return {{p[0].x(), p[1].x(), p[2].x(), p[3].x()}, {p[0].y(), p[1].y(), p[2].y(), p[3].y()}};
}

double sum_of(const Four& four) {
    return (four[0] + four[1]) + (four[2] + four[3]);
}

template <class Points>
Eigen::Vector2d mean_of(const Points& points) {
    Four x = Four::Zero();
    Four y = Four::Zero();
    std::size_t i = 0;
    for (; i + 4 <= points.size(); i += 4) {
        const FourPoints p = four_points(points, i);
        x += p.x;
        y += p.y;
    }
    Eigen::Vector2d rest = Eigen::Vector2d::Zero();
    for (; i < points.size(); ++i) rest += points[i];
    return (rest + Eigen::Vector2d(sum_of(x), sum_of(y))) / static_cast<double>(points.size());
}

struct Scatter {
    double xx, xy, yy;
};

template <class Points>
Scatter scatter_about(const Eigen::Vector2d& mean, const Points& points) {
    Four xx = Four::Zero();
    Four xy = Four::Zero();
    Four yy = Four::Zero();
    std::size_t i = 0;
    for (; i + 4 <= points.size(); i += 4) {
        const FourPoints p = four_points(points, i);
        const Four x = p.x - mean.x();
        const Four y = p.y - mean.y();
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    Scatter scatter{sum_of(xx), sum_of(xy), sum_of(yy)};
    for (; i < points.size(); ++i) {
        const Eigen::Vector2d q = points[i] - mean;
        scatter.xx += q.x() * q.x();
        scatter.xy += q.x() * q.y();
        scatter.yy += q.y() * q.y();
    }
    return scatter;
}

template <class Points>
std::optional<Line> fit(const Points& points) {
    if (points.size() < 2) return std::nullopt;
    const Eigen::Vector2d mean = mean_of(points);
    const Scatter scatter = scatter_about(mean, points);
    // The scatter's axes differ by the hypotenuse, mostly by far more than the rounding of the coordinates'
    // squares, which is about 1e-16 of them.
    const double rounding = 1e-13 * (mean.squaredNorm() + 1.0) * static_cast<double>(points.size());
    const double difference = scatter.xx - scatter.yy;
    const double twice = 2.0 * scatter.xy;
    const double hypotenuse = std::hypot(difference, twice);
    if (!(hypotenuse > rounding)) return std::nullopt;

    // The larger eigenvector of the scatter matrix is at half the angle of (difference, twice): of the two
    // ways to write that, the one that subtracts nothing.
    if (difference > 0.0) return line_with_normal({-twice, hypotenuse + difference}, mean);
    return line_with_normal({difference - hypotenuse, twice}, mean);
}

template <class Points>
double rms(const Line& line, const Points& points) {
    assert(points.size() > 0);
    Four four = Four::Zero();
    std::size_t i = 0;
    for (; i + 4 <= points.size(); i += 4) {
        const FourPoints p = four_points(points, i);
        four += (line.normal.x() * p.x + line.normal.y() * p.y - line.offset).square();
    }
    double squares = sum_of(four);
    for (; i < points.size(); ++i) {
        const double distance = line.signed_distance(points[i]);
        squares += distance * distance;
    }
    return std::sqrt(squares / static_cast<double>(points.size()));
}

template <class Points>
LineSegment segment(const Line& line, const Points& points) {
    assert(points.size() > 0);
    const Eigen::Vector2d along = line.direction();
    Four firsts = Four::Constant(along.dot(points[0]));
    Four lasts = firsts;
    std::size_t i = 0;
    for (; i + 4 <= points.size(); i += 4) {
        const FourPoints p = four_points(points, i);
        const Four s = along.x() * p.x + along.y() * p.y;
        firsts = firsts.min(s);
        lasts = lasts.max(s);
    }
    double first = firsts.minCoeff();
    double last = lasts.maxCoeff();
    for (; i < points.size(); ++i) {
        const double s = along.dot(points[i]);
        first = std::min(first, s);
        last = std::max(last, s);
    }
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

double rms_distance(const Line& line, std::span<const Eigen::Vector2d> points) {
    return rms(line, points);
}

double rms_distance(const Line& line, const PointColumns& points) {
    return rms(line, points);
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
