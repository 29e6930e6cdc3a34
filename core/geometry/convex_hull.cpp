#include "core/geometry/convex_hull.h"

#include <algorithm>
#include <cassert>

namespace goalmouth {
namespace {

/// Positive where a → b → c turns towards larger y, which is clockwise to somebody who looks at the image.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

void upper_hull(std::span<Eigen::Vector2d> points, std::vector<Eigen::Vector2d>& hull) {
    const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    };
    if (!std::is_sorted(points.begin(), points.end(), before))
        std::sort(points.begin(), points.end(), before);
    hull.clear();
    for (const auto& p : points) {
        if (!hull.empty() && hull.back().x() == p.x()) continue;
        while (hull.size() >= 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
        hull.push_back(p);
    }
}

std::vector<Eigen::Vector2d> upper_hull(std::vector<Eigen::Vector2d> points) {
    std::vector<Eigen::Vector2d> hull;
    upper_hull(points, hull);
    return hull;
}

double chain_y_at(std::span<const Eigen::Vector2d> chain, double x) {
    assert(!chain.empty());
    if (!(x > chain.front().x())) return chain.front().y();
    if (x >= chain.back().x()) return chain.back().y();
    const auto right = std::upper_bound(chain.begin(), chain.end(), x,
                                        [](double value, const Eigen::Vector2d& p) { return value < p.x(); });
    const Eigen::Vector2d& b = *right;
    const Eigen::Vector2d& a = *(right - 1);
    return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
}

}  // namespace goalmouth
