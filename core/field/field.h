#pragma once

#include "core/parameters/parameters.h"

#include <array>
#include <string>

#include <Eigen/Core>

namespace goalmouth {

/// A soccer field and its two goals [m]. Frame W: origin at the centre, x towards the opponents' goal, y
/// left. Lines are measured to their middles; goal lines lie at x = ±length/2.
struct Field {
    std::string name = "KidSize 2013";
    double length = 6.0;
    double width = 4.0;
    double border_strip = 0.7;  // green beyond the lines
    double line_width = 0.05;
    double circle_diameter = 1.2;  // to the line's middle
    double goal_area_depth = 0.6;
    double goal_area_width = 2.2;
    double penalty_mark_distance = 1.8;  // from the goal line
    double mark_size = 0.1;              // length of a mark's strokes
    double goal_width = 1.5;             // between the posts' axes
    double goal_height = 0.9;            // axis of the crossbar above ground
    double goal_depth = 0.5;
    double post_diameter = 0.1;
    std::string goal_colour = "yellow";
    double ball_diameter = 0.065;

    /// Axes of the posts on the ground: own goal left (y > 0), own right, opponents' left (y > 0), opponents'
    /// right; ids as in truth_post_t. "Left" is y > 0 for both goals here.
    std::array<Eigen::Vector2d, 4> posts() const;
};

template <class Visitor>
void describe_parameters(Visitor& v, Field& p) {
    v("name", p.name, Text{}, "name shown to people");
    v("length", p.length, Range{1, 120}, "m", "between the goal lines' middles, along x");
    v("width", p.width, Range{1, 90}, "m", "between the side lines' middles, along y");
    v("border_strip", p.border_strip, Range{0, 10}, "m", "green beyond the lines");
    v("line_width", p.line_width, Range{0.01, 0.5}, "m", "width of the lines");
    v("circle_diameter", p.circle_diameter, Range{0, 30}, "m", "centre circle, to the middle of its line");
    v("goal_area_depth", p.goal_area_depth, Range{0, 20}, "m", "goal area, from the goal line");
    v("goal_area_width", p.goal_area_width, Range{0, 50}, "m", "goal area, along the goal line");
    v("penalty_mark_distance", p.penalty_mark_distance, Range{0, 20}, "m",
      "penalty mark, from the goal line");
    v("mark_size", p.mark_size, Range{0, 1}, "m", "length of the strokes of penalty and centre marks");
    v("goal_width", p.goal_width, Range{0.5, 10}, "m", "between the axes of a goal's posts");
    v("goal_height", p.goal_height, Range{0.2, 4}, "m", "axis of the crossbar above the ground");
    v("goal_depth", p.goal_depth, Range{0, 4}, "m", "how far the goal's frame reaches behind the goal line");
    v("post_diameter", p.post_diameter, Range{0.01, 0.5}, "m", "diameter of posts and crossbar");
    v("goal_colour", p.goal_colour, Choice{"yellow", "white"}, "colour of the goals");
    v("ball_diameter", p.ball_diameter, Range{0.02, 0.5}, "m", "diameter of the ball");
}

}  // namespace goalmouth
