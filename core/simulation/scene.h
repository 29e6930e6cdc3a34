#pragma once

#include "core/field/field.h"
#include "core/field/layout.h"
#include "core/geometry/cylinder.h"
#include "core/parameters/parameters.h"
#include "core/simulation/colour.h"

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// What stands in the hall and in which colours. Colours are [red, green, blue] in 0…255 under light of
/// factor 1.
struct SceneParameters {
    std::vector<double> carpet = {52, 122, 62};
    std::vector<double> line = {226, 228, 222};
    std::vector<double> yellow_goal = {226, 184, 34};
    std::vector<double> white_goal = {232, 233, 228};
    std::vector<double> ball = {228, 96, 28};
    std::vector<double> floor = {112, 108, 110};
    std::vector<double> wall = {186, 186, 190};
    double mottle = 0.05;
    bool own_goal = true;
    bool goal_frame = true;
    double room_margin = 1.6;
    double room_height = 3.0;
    int posters = 22;
    int spectators = 7;
    int distractors = 0;
    int robots = 0;
    bool any_colour = false;
    int clutter_seed = 7;
    double ball_x = -1.2;
    double ball_y = 0.0;
    bool ball_on_penalty_mark = true;
};

template <class Visitor>
void describe_parameters(Visitor& v, SceneParameters& p) {
    const Range level{0, 255};
    v("carpet", p.carpet, level, "1", "colour of the carpet [red, green, blue]");
    v("line", p.line, level, "1", "colour of the lines");
    v("yellow_goal", p.yellow_goal, level, "1", "colour of the goals of a field whose goal_colour is yellow");
    v("white_goal", p.white_goal, level, "1", "colour of the goals of a field whose goal_colour is white");
    v("ball", p.ball, level, "1", "colour of the ball");
    v("floor", p.floor, level, "1", "colour of the floor beyond the carpet");
    v("wall", p.wall, level, "1", "colour of the walls");
    v("mottle", p.mottle, Range{0, 0.5}, "1",
      "σ of the carpet's brightness from spot to spot, as a share of it");
    v("own_goal", p.own_goal, "the own goal stands too; false: only the opponents'");
    v("goal_frame", p.goal_frame, "thin white struts behind the goals, as nets hang on");
    v("room_margin", p.room_margin, Range{0.1, 100}, "m", "from the carpet to the walls");
    v("room_height", p.room_height, Range{1, 30}, "m", "height of the walls");
    v("posters", p.posters, Range{0, 200}, "1", "coloured rectangles on the walls");
    v("spectators", p.spectators, Range{0, 100}, "1", "people between carpet and walls");
    v("distractors", p.distractors, Range{0, 100}, "1",
      "things in the goals' colour beyond the carpet: poles, banners, shirts");
    v("robots", p.robots, Range{0, 20}, "1", "other robots on the field, some of them fallen");
    v("any_colour", p.any_colour,
      "posters and clothes in any colour, also the carpet's and the goals'; false: in colours like neither");
    v("clutter_seed", p.clutter_seed, Range{0, 1e9}, "1",
      "posters, spectators, distractors and robots are drawn from it, nothing else is");
    v("ball_on_penalty_mark", p.ball_on_penalty_mark,
      "the ball lies on the own half's penalty mark, not at ball_x, ball_y");
    v("ball_x", p.ball_x, Range{-100, 100}, "m", "where the ball lies, frame W");
    v("ball_y", p.ball_y, Range{-100, 100}, "m", "where the ball lies, frame W");
}

/// A cylinder of one colour.
struct Tube {
    /// What it belongs to.
    enum class Of { goal, robot, hall };

    Cylinder cylinder;
    Rgb colour;
    Of of = Of::goal;
    int post = -1;  // which of Scene::posts it is, if one
};

/// A flat rectangle of one colour, corners in order around it; seen from both sides.
struct Panel {
    std::array<Eigen::Vector3d, 4> corners;
    Rgb colour;
};

struct Ball {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0325;
    Rgb colour;
};

/// Everything a ray may hit, in frame W [m]. Later panels lie before earlier ones (a poster before its wall),
/// all of them behind every tube.
struct Scene {
    Field field;
    FieldLayout layout;
    Rgb carpet;
    Rgb line;
    Rgb floor;
    Rgb ceiling;
    double mottle = 0.0;
    std::vector<Panel> panels;
    std::vector<Tube> tubes;        // the goals, then people and other things, then robots
    std::array<Cylinder, 4> posts;  // numbered as Field::posts(), also those that do not stand
    bool own_goal = true;           // stands, as the opponents' always does
    Ball ball;

    /// Whether a post stands: then it is in tubes.
    bool stands(std::size_t post) const { return own_goal || post >= 2; }
};

/// Cylinder about the segment from…to [m].
Cylinder cylinder_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// The four posts: upright, from the ground to the upper edge of the crossbar.
std::array<Cylinder, 4> goalposts(const Field& field);
/// The crossbars of the own and the opponents' goal, from post axis to post axis.
std::array<Cylinder, 2> crossbars(const Field& field);

/// The same parameters give the same scene. As many robots as find room. Throws std::invalid_argument where a
/// colour is not three levels.
Scene make_scene(const Field& field, const SceneParameters& parameters);

}  // namespace goalmouth
