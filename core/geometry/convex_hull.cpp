#include "core/geometry/convex_hull.h"

#include <algorithm>

namespace goalmouth {
namespace {

/// Positive where a → b → c turns towards larger y, which is clockwise to somebody who looks at the image.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

std::vector<Eigen::Vector2d> upper_hull(std::vector<Eigen::Vector2d> points) {
    std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    });
    std::vector<Eigen::Vector2d> hull;
    for (const auto& p : points) {
        if (!hull.empty() && hull.back().x() == p.x()) continue;
        while (hull.size() >= 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
        hull.push_back(p);
    }
    return hull;
}

}  // namespace goalmouth
