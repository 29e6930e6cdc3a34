#include "tools/evaluate/report/field_figure.h"

#include "core/field/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace goalmouth {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void lift(Series& line) {
    line.x.push_back(not_a_number);
    line.y.push_back(not_a_number);
}

void add(Series& line, const Eigen::Vector2d& point) {
    line.x.push_back(point.x());
    line.y.push_back(point.y());
}

void add_circle(Series& line, const Eigen::Vector2d& centre, double radius, int corners) {
    for (int i = 0; i <= corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / corners;
        add(line, centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    lift(line);
}

Series background(SeriesStyle::Kind kind, int colour) {
    Series line;
    line.style.kind = kind;
    line.style.colour = colour;
    line.style.faint = true;
    return line;
}

Series painted_lines(const FieldLayout& paint) {
    Series lines = background(SeriesStyle::Kind::line, SeriesStyle::neutral);
    for (const Stroke& stroke : paint.strokes) {
        add(lines, stroke.from);
        add(lines, stroke.to);
        lift(lines);
    }
    for (const Ring& ring : paint.rings) add_circle(lines, ring.centre, ring.radius, 72);
    return lines;
}

/// Posts as circles, and the frames behind them.
Series goals(const Field& field) {
    Series lines = background(SeriesStyle::Kind::line, SeriesStyle::neutral);
    lines.style.faint = false;
    for (const Eigen::Vector2d& post : field.posts()) add_circle(lines, post, field.post_diameter / 2.0, 16);
    for (const double side : {-1.0, 1.0}) {
        const double front = side * field.length / 2.0;
        const double back = front + side * field.goal_depth;
        const double half = field.goal_width / 2.0;
        for (const Eigen::Vector2d& corner : {Eigen::Vector2d(front, half), Eigen::Vector2d(back, half),
                                              Eigen::Vector2d(back, -half), Eigen::Vector2d(front, -half)})
            add(lines, corner);
        lift(lines);
    }
    return lines;
}

}  // namespace

Figure field_figure(const Field& field, const std::string& title) {
    const FieldLayout paint = layout(field);
    Figure figure;
    figure.title = title;
    figure.x_label = "x [m]";
    figure.y_label = "y [m]";
    figure.equal_axes = true;
    const double half_length =
        std::max(paint.carpet_half_length, field.length / 2.0 + field.goal_depth + 0.1);
    const double half_width = paint.carpet_half_width;
    figure.x_range = {-half_length, half_length};
    figure.y_range = {-half_width, half_width};
    figure.width = 760;
    constexpr double left_and_right = 90.0;  // px beside the drawing
    constexpr double above_and_below = 130.0;
    figure.height = static_cast<int>(
        std::lround((figure.width - left_and_right) * half_width / half_length + above_and_below));
    figure.series.push_back(painted_lines(paint));
    figure.series.push_back(goals(field));
    return figure;
}

Series path_series(const std::vector<Pose2>& path, const std::string& name, const SeriesStyle& style) {
    constexpr double longest_step = 0.5;    // m; a robot that is carried leaves no path
    constexpr double shortest_step = 0.02;  // m, two pixels; nearer points only make the figure's file large
    Series series;
    series.name = name;
    series.style = style;
    series.style.kind = SeriesStyle::Kind::line;
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool jumps = i > 0 && (path[i].position() - path[i - 1].position()).norm() > longest_step;
        const bool ends = i == 0 || i + 1 == path.size() || jumps;
        if (!ends && (path[i].position() - path[drawn].position()).norm() < shortest_step) continue;
        if (jumps) lift(series);
        add(series, path[i].position());
        drawn = i;
    }
    return series;
}

}  // namespace goalmouth
