#include "core/extraction/border.h"

#include "core/geometry/convex_hull.h"

#include <algorithm>

namespace goalmouth {

double FieldBorder::y_at(double x) const {
    return chain_y_at(hull, x);
}

const FieldBorder& BorderFinder::find(const Segments& segments) {
    border_.points.clear();
    for (const ScanLine& line : segments.lines) {
        if (line.orientation != Orientation::vertical) continue;
        const auto begin = segments.segments.begin() + line.first;
        const auto end = begin + line.count;
        const auto top = std::find_if(begin, end, [&](const Segment& s) {
            return s.colour == Colour::field && s.length() >= parameters_.green_run;
        });
        if (top != end) border_.points.emplace_back(line.position, top->start);
    }
    sorted_ = border_.points;
    upper_hull(sorted_, border_.hull);
    return border_;
}

FieldBorder find_border(const Segments& segments, const BorderParameters& parameters) {
    return BorderFinder(parameters).find(segments);
}

}  // namespace goalmouth
