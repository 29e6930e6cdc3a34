#include "core/simulation/scene.h"

#include "core/simulation/clutter.h"
#include "core/simulation/robot.h"
#include "core/simulation/room.h"

namespace goalmouth {
namespace {

using Eigen::Vector3d;

void add_goals(Scene& scene, const Rgb& colour, bool frame) {
    const Field& field = scene.field;
    scene.posts = goalposts(field);
    for (std::size_t i = 0; i < scene.posts.size(); ++i)
        if (scene.stands(i))
            scene.tubes.push_back({scene.posts[i], colour, Tube::Of::goal, static_cast<int>(i)});
    const auto bars = crossbars(field);
    if (scene.own_goal) scene.tubes.push_back({bars[0], colour});
    scene.tubes.push_back({bars[1], colour});
    if (!frame || field.goal_depth <= 0.0) return;
    const Rgb struts{205, 206, 204};
    constexpr double radius = 0.008;  // m
    const auto add = [&](const Vector3d& from, const Vector3d& to) {
        scene.tubes.push_back({cylinder_between(from, to, radius), struts});
    };
    for (const double side : {-1.0, 1.0}) {
        if (side < 0.0 && !scene.own_goal) continue;
        const double line = side * field.length / 2.0;
        const double back = line + side * field.goal_depth;
        const double y = field.goal_width / 2.0;
        for (const double s : {-1.0, 1.0}) {
            const Vector3d corner(back, s * y, radius);
            add({line, s * y, field.goal_height}, corner);
            add({line, s * y, radius}, corner);
        }
        add({back, -y, radius}, {back, y, radius});
    }
}

}  // namespace

Cylinder cylinder_between(const Vector3d& from, const Vector3d& to, double radius) {
    const Vector3d run = to - from;
    return {from, run.normalized(), run.norm(), radius};
}

std::array<Cylinder, 4> goalposts(const Field& field) {
    std::array<Cylinder, 4> posts;
    const auto feet = field.posts();
    const double radius = field.post_diameter / 2.0;
    for (std::size_t i = 0; i < posts.size(); ++i)
        posts[i] = {{feet[i].x(), feet[i].y(), 0.0}, Vector3d::UnitZ(), field.goal_height + radius, radius};
    return posts;
}

std::array<Cylinder, 2> crossbars(const Field& field) {
    const auto feet = field.posts();
    const auto bar = [&](std::size_t left, std::size_t right) {
        return cylinder_between({feet[right].x(), feet[right].y(), field.goal_height},
                                {feet[left].x(), feet[left].y(), field.goal_height},
                                field.post_diameter / 2.0);
    };
    return {bar(0, 1), bar(2, 3)};
}

Scene make_scene(const Field& field, const SceneParameters& p) {
    Scene scene;
    scene.field = field;
    scene.layout = layout(field);
    scene.carpet = rgb_parameter("carpet", p.carpet);
    scene.line = rgb_parameter("line", p.line);
    scene.floor = rgb_parameter("floor", p.floor);
    scene.ceiling = {206, 206, 208};
    scene.mottle = p.mottle;
    scene.ball.radius = field.ball_diameter / 2.0;
    scene.ball.colour = rgb_parameter("ball", p.ball);
    const double mark = -(field.length / 2.0 - field.penalty_mark_distance);
    scene.ball.centre = p.ball_on_penalty_mark ? Vector3d(mark, 0.0, scene.ball.radius)
                                               : Vector3d(p.ball_x, p.ball_y, scene.ball.radius);
    scene.own_goal = p.own_goal;
    const Rgb goals = field.goal_colour == "white" ? rgb_parameter("white_goal", p.white_goal)
                                                   : rgb_parameter("yellow_goal", p.yellow_goal);
    const Room room(scene.layout, p);
    room.add_walls(scene, rgb_parameter("wall", p.wall));
    add_posters(scene, room, p);
    add_goals(scene, goals, p.goal_frame);
    add_spectators(scene, p);
    add_distractors(scene, room, p, goals);
    add_robots(scene, p);
    return scene;
}

}  // namespace goalmouth
