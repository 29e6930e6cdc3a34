#include "core/field/layout.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

FieldLayout layout(const Field& field) {
    FieldLayout result;
    const double w = field.line_width;
    const double x = field.length / 2.0;
    const double y = field.width / 2.0;
    const double half = w / 2.0;
    const auto stroke = [&](double x0, double y0, double x1, double y1) {
        result.strokes.push_back({{x0, y0}, {x1, y1}, w});
    };
    for (const double side : {-1.0, 1.0}) {
        stroke(-x - half, side * y, x + half, side * y);
        stroke(side * x, -y - half, side * x, y + half);
        if (field.goal_area_depth > 0.0 && field.goal_area_width > 0.0) {
            const double front = side * (x - field.goal_area_depth);
            const double edge = field.goal_area_width / 2.0;
            stroke(front, -edge - half, front, edge + half);
            stroke(front, edge, side * x, edge);
            stroke(front, -edge, side * x, -edge);
        }
    }
    stroke(0.0, -y, 0.0, y);
    if (field.circle_diameter > 0.0) result.rings.push_back({{0.0, 0.0}, field.circle_diameter / 2.0, w});
    if (field.mark_size > 0.0) {
        const double arm = field.mark_size / 2.0;
        stroke(-arm, 0.0, arm, 0.0);  // the halfway line is the centre mark's other stroke
        for (const double side : {-1.0, 1.0}) {
            const double mark = side * (x - field.penalty_mark_distance);
            stroke(mark - arm, 0.0, mark + arm, 0.0);
            stroke(mark, -arm, mark, arm);
        }
    }
    result.carpet_half_length = x + field.border_strip;
    result.carpet_half_width = y + field.border_strip;
    return result;
}

double distance_to(const Stroke& stroke, const Eigen::Vector2d& point) {
    const Eigen::Vector2d run = stroke.to - stroke.from;
    const double length = run.norm();
    const Eigen::Vector2d along = length > 0.0 ? Eigen::Vector2d(run / length) : Eigen::Vector2d::UnitX();
    const Eigen::Vector2d p = point - 0.5 * (stroke.from + stroke.to);
    const double beyond_end = std::abs(p.dot(along)) - length / 2.0;
    const double beyond_side = std::abs(along.x() * p.y() - along.y() * p.x()) - stroke.width / 2.0;
    return std::hypot(std::max(0.0, beyond_end), std::max(0.0, beyond_side));
}

double distance_to(const Ring& ring, const Eigen::Vector2d& point) {
    return std::max(0.0, std::abs((point - ring.centre).norm() - ring.radius) - ring.width / 2.0);
}

bool on_line(const FieldLayout& layout, const Eigen::Vector2d& point) {
    const auto painted = [&](const auto& part) { return distance_to(part, point) <= 0.0; };
    return std::any_of(layout.strokes.begin(), layout.strokes.end(), painted) ||
           std::any_of(layout.rings.begin(), layout.rings.end(), painted);
}

}  // namespace goalmouth
