#include "core/simulation/route.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace goalmouth {
namespace {

constexpr std::size_t pieces = 64;  // of a spline segment, for arc length

}  // namespace

Route::Route(const Eigen::Vector2d& start, const Eigen::Vector2d& towards,
             const std::vector<Eigen::Vector2d>& lead_in, const std::vector<Eigen::Vector2d>& loop) {
    if ((towards - start).norm() < 1e-6)
        throw std::invalid_argument("a route's start and first goal are one point");
    if (loop.size() < 3) throw std::invalid_argument("a route's loop needs three points");
    // The spline passes (a + 4b + c) / 6: through `start` if its neighbours lie evenly on both sides.
    const Eigen::Vector2d first = std::min(1.0, 0.5 / (towards - start).norm()) * (towards - start);
    points_ = {start - first, start, start + first};
    points_.insert(points_.end(), lead_in.begin(), lead_in.end());
    const std::size_t loop_segment = points_.size();
    points_.insert(points_.end(), loop.begin(), loop.end());
    points_.insert(points_.end(), loop.begin(), loop.begin() + 3);

    const std::size_t segments = points_.size() - 3;
    lengths_ = {0.0};
    Eigen::Vector2d last = position(0, 0.0);
    for (std::size_t i = 0; i < segments; ++i) {
        if (i == loop_segment) lead_in_length_ = lengths_.back();
        for (std::size_t k = 1; k <= pieces; ++k) {
            const Eigen::Vector2d p = position(i, static_cast<double>(k) / pieces);
            lengths_.push_back(lengths_.back() + (p - last).norm());
            last = p;
        }
    }
}

Eigen::Vector2d Route::position(std::size_t segment, double u) const {
    const double v = 1.0 - u;
    return (v * v * v * points_[segment] + (3.0 * u * u * u - 6.0 * u * u + 4.0) * points_[segment + 1] +
            (3.0 * v * v * v - 6.0 * v * v + 4.0) * points_[segment + 2] + u * u * u * points_[segment + 3]) /
           6.0;
}

Eigen::Vector2d Route::tangent(std::size_t segment, double u) const {
    const double v = 1.0 - u;
    return 0.5 * (v * v * (points_[segment + 1] - points_[segment]) +
                  (1.0 + 2.0 * u * v) * (points_[segment + 2] - points_[segment + 1]) +
                  u * u * (points_[segment + 3] - points_[segment + 2]));
}

Pose2 Route::at(double distance) const {
    double s = std::max(0.0, distance);
    if (s >= lengths_.back()) s = lead_in_length_ + std::fmod(s - lead_in_length_, loop_length());
    const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, s);
    const auto piece = static_cast<std::size_t>(next - lengths_.begin()) - 1;
    const double share = (s - lengths_[piece]) / (lengths_[piece + 1] - lengths_[piece]);
    const double u = (static_cast<double>(piece % pieces) + share) / pieces;
    const Eigen::Vector2d p = position(piece / pieces, u);
    const Eigen::Vector2d t = tangent(piece / pieces, u);
    return {p.x(), p.y(), std::atan2(t.y(), t.x())};
}

Route paper_route(const Field& field) {
    const double x = field.length / 2.0;
    const double y = field.width / 2.0;
    const double mark = -(x - field.penalty_mark_distance);
    const Eigen::Vector2d start(-0.5 * (x + field.circle_diameter / 2.0), -y);
    const Eigen::Vector2d beside_mark(mark - 0.25, 0.0);
    // In shares of the half field. Steps between points are long enough for a humanoid's turns.
    constexpr std::array<std::array<double, 2>, 9> eight = {{{-0.50, 0.55},
                                                             {-0.10, 0.50},
                                                             {0.30, 0.20},
                                                             {0.60, -0.10},
                                                             {0.62, -0.50},
                                                             {0.30, -0.60},
                                                             {-0.10, -0.30},
                                                             {-0.50, -0.10},
                                                             {-0.72, 0.15}}};
    std::vector<Eigen::Vector2d> loop;
    for (const auto& p : eight) loop.emplace_back(p[0] * x, p[1] * y);
    return Route(start, beside_mark, {beside_mark}, loop);
}

}  // namespace goalmouth
