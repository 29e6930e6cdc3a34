#pragma once

#include "core/field/field.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// A straight painted line: a rectangle `width` wide about the segment from…to, with square ends. Frame W
/// [m].
struct Stroke {
    Eigen::Vector2d from;
    Eigen::Vector2d to;
    double width = 0.05;
};

/// A painted circle line: `width` wide about the circle.
struct Ring {
    Eigen::Vector2d centre;
    double radius = 0.6;
    double width = 0.05;
};

/// What is painted on a field: side lines, goal lines, halfway line, goal areas, centre circle, centre and
/// penalty marks. Strokes reach to the outer edge of the lines they meet, so that corners are full.
struct FieldLayout {
    std::vector<Stroke> strokes;
    std::vector<Ring> rings;
    double carpet_half_length = 0.0;  // m, border strip included
    double carpet_half_width = 0.0;   // m
};

/// Parts of size 0 (no goal area, no circle, no marks) are left out.
FieldLayout layout(const Field& field);

/// Distance [m] from a point to the paint of a stroke or ring; 0 on it.
double distance_to(const Stroke& stroke, const Eigen::Vector2d& point);
double distance_to(const Ring& ring, const Eigen::Vector2d& point);

/// True where the point lies on a painted line.
bool on_line(const FieldLayout& layout, const Eigen::Vector2d& point);

}  // namespace goalmouth
