#include "core/extraction/border.h"

#include "core/geometry/convex_hull.h"

#include <algorithm>
#include <cassert>

namespace goalmouth {

double FieldBorder::y_at(double x) const {
    assert(!hull.empty());
    if (x <= hull.front().x()) return hull.front().y();
    if (x >= hull.back().x()) return hull.back().y();
    const auto right = std::upper_bound(hull.begin(), hull.end(), x,
                                        [](double value, const Eigen::Vector2d& p) { return value < p.x(); });
    const Eigen::Vector2d& b = *right;
    const Eigen::Vector2d& a = *(right - 1);
    return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
}

FieldBorder find_border(const Segments& segments, const BorderParameters& parameters) {
    FieldBorder border;
    for (const ScanLine& line : segments.lines) {
        if (line.orientation != Orientation::vertical) continue;
        const auto begin = segments.segments.begin() + line.first;
        const auto end = begin + line.count;
        const auto top = std::find_if(begin, end, [&](const Segment& s) {
            return s.colour == Colour::field && s.length() >= parameters.green_run;
        });
        if (top != end) border.points.emplace_back(line.position, top->start);
    }
    border.hull = upper_hull(border.points);
    return border;
}

}  // namespace goalmouth
