#include "core/refinement/luma_line.h"

#include "core/refinement/whole_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Dense>

namespace goalmouth {
namespace {

constexpr int farthest = 8;            // px, of the course to either side
constexpr int nearest = 2;             // px, the way in
constexpr double least_inside = 2.0;   // px, the way out
constexpr double enough_inside = 3.0;  // px, of these that show no edge; else the edge is looked at too
constexpr std::size_t least_rows = 5;
constexpr double roughness = 0.02;     // levels², of a mean course: surfaces are never that smooth
constexpr double shading_error = 0.5;  // levels, of a step in the shading: where lamps cease to reach, say

/// Luma at a column between pixels; negative outside the row.
double luma_at(const std::uint8_t* row, int width, double x) {
    const int left = whole_below(x);
    if (left < 0 || left + 1 >= width) return -1.0;
    const double share = x - left;
    return (1.0 - share) * row[2 * left] + share * row[2 * left + 2];
}

/// Mean of the rows' courses, each less its own mean, and the variance of each of its values.
struct Course {
    Eigen::ArrayXd mean, variance;
};

std::optional<Course> course_of(YuyvView image, const std::vector<LinePoint>& points, int outwards, int first,
                                int last, int own) {
    const int length = last - first + 1;
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(length), squares = sum, course(length);
    std::size_t rows = 0;
    for (const LinePoint& point : points) {
        const std::uint8_t* row = image.row(point.y);
        for (int i = 0; i < length; ++i)
            course[i] = luma_at(row, image.width, point.x + outwards * (first + i));
        if (course.minCoeff() < 0.0) continue;
        course -= course.head(own).mean();
        sum += course;
        squares += course.square();
        ++rows;
    }
    if (rows < least_rows) return std::nullopt;
    const auto n = static_cast<double>(rows);
    const Eigen::ArrayXd mean = sum / n;
    return Course{mean, (squares / n - mean.square()).max(0.0) / (n - 1.0) + roughness};
}

double blurred_step(double sigmas) {
    return 0.5 * std::erf(sigmas * std::sqrt(0.5));
}

double ridge(double sigmas) {
    return std::exp(-0.5 * sigmas * sigmas);
}

/// A part of the cylinder's shading at a distance [px] outwards of the line; it ends at the edges.
double shading(const SupposedCylinder& cylinder, double away, int part) {
    const double u = 1.0 + 2.0 * (away - cylinder.inside) / cylinder.width;
    if (!(std::abs(u) < 1.0)) return 0.0;
    switch (part) {
        case 0:
            return 1.0;
        case 1:
            return u;
        case 2:
            return std::sqrt(1.0 - u * u);
        default:
            return u * u;
    }
}

template <class Course>
double blurred(double x, double sigma, const Course& course) {
    constexpr int pieces = 24;
    constexpr double reach = 3.0;  // sigmas
    double sum = 0.0, weights = 0.0;
    for (int k = -pieces; k <= pieces; ++k) {
        const double off = reach * k / pieces, weight = ridge(off);
        sum += weight * course(x + off * sigma);
        weights += weight;
    }
    return sum / weights;
}

}  // namespace

std::optional<LumaLine> luma_line(YuyvView image, const std::vector<LinePoint>& points,
                                  const SupposedCylinder& cylinder) {
    // Pixels gather light over 1 px, as does what lies between two.
    const double sigma = std::sqrt(cylinder.blur * cylinder.blur + 0.25);
    const double clear = 2.5 * sigma;
    if (!(cylinder.inside > least_inside)) return std::nullopt;
    const int first = -whole_below(std::min<double>(farthest, cylinder.width - cylinder.inside - clear));
    const bool edge = cylinder.inside - clear < enough_inside;
    const int last = edge ? whole_above(cylinder.inside + 2.0)
                          : whole_below(std::min<double>(farthest, cylinder.inside - clear));
    const int own = edge ? std::max(1, whole_below(cylinder.inside - clear) - first + 1) : last - first + 1;
    const int length = last - first + 1;
    const int others = edge ? 7 : 4;
    if (-first < nearest || length < others + 3) return std::nullopt;
    const auto course = course_of(image, points, cylinder.outwards, first, last, own);
    if (!course) return std::nullopt;

    Eigen::MatrixXd parts(length, 2 + others);  // the step, then the ridge, then the cylinder
    for (int i = 0; i < length; ++i) {
        const double away = first + i;
        parts(i, 0) = blurred_step(away / sigma);
        parts(i, 1) = ridge(away / sigma);
        for (int k = 0; k < 4; ++k)
            parts(i, 2 + k) = blurred(away, sigma, [&](double x) { return shading(cylinder, x, k); });
        if (!edge) continue;
        const double beyond = (away - cylinder.inside) / sigma;
        parts(i, 6) = blurred_step(beyond);
        parts(i, 7) = ridge(beyond);           // it lies a little beside
        parts(i, 8) = beyond * ridge(beyond);  // and is less sharp
    }
    const Eigen::ArrayXd weight = course->variance.rsqrt();
    const Eigen::VectorXd told = (course->mean * weight).matrix();
    const Eigen::MatrixXd weighed = weight.matrix().asDiagonal() * parts;
    const auto misfit = [&](const Eigen::MatrixXd& of) {
        return (told - of * of.colPivHouseholderQr().solve(told)).squaredNorm();
    };
    const Eigen::MatrixXd smooth = weighed.rightCols(others);
    // What of a step the cylinder cannot be.
    const Eigen::VectorXd step = weighed.col(0);
    const double own_step = (step - smooth * smooth.colPivHouseholderQr().solve(step)).norm();
    const double by_noise = 1.0 / std::max(own_step, 1e-6);
    const double in_all = std::hypot(by_noise, shading_error);
    const double share = by_noise / in_all;
    return LumaLine{(misfit(smooth) - misfit(weighed)) * share * share, in_all};
}

}  // namespace goalmouth
