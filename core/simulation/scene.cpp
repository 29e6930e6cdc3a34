#include "core/simulation/scene.h"

#include "core/random/random.h"

#include <cmath>

namespace goalmouth {
namespace {

using Eigen::Vector3d;

Cylinder between(const Vector3d& from, const Vector3d& to, double radius) {
    const Vector3d run = to - from;
    return {from, run.normalized(), run.norm(), radius};
}

/// Cloth, paper and wood as halls have them; nothing of a goal's yellow or a carpet's green.
constexpr std::array<Rgb, 12> clutter_colours = {{{34, 52, 110},
                                                  {150, 32, 38},
                                                  {58, 60, 66},
                                                  {224, 224, 228},
                                                  {120, 78, 58},
                                                  {30, 30, 34},
                                                  {70, 120, 170},
                                                  {128, 62, 120},
                                                  {150, 146, 150},
                                                  {88, 96, 128},
                                                  {196, 170, 160},
                                                  {40, 96, 118}}};

Rgb draw_colour(Random& random) {
    return clutter_colours[random.index(clutter_colours.size())];
}

void add_room(Scene& scene, const SceneParameters& p) {
    const double x = scene.layout.carpet_half_length + p.room_margin;
    const double y = scene.layout.carpet_half_width + p.room_margin;
    const Rgb skirting{70, 66, 66};
    const Rgb wall = rgb_parameter("wall", p.wall);
    const std::array<Vector3d, 4> corners = {Vector3d(-x, -y, 0), Vector3d(x, -y, 0), Vector3d(x, y, 0),
                                             Vector3d(-x, y, 0)};
    const Vector3d up(0, 0, p.room_height);
    const auto patch = [&](std::size_t side, double from, double to, double bottom, double top, Rgb colour) {
        const Vector3d& a = corners[side];
        const Vector3d& b = corners[(side + 1) % 4];
        const Vector3d along = (b - a).normalized();
        // A millimetre into the room, so that nothing depends on which of two equal planes is nearer.
        const Vector3d inwards = 0.001 * Vector3d::UnitZ().cross(along);
        const Vector3d s = a + from * along + inwards;
        const Vector3d e = a + to * along + inwards;
        scene.panels.push_back({{s + Vector3d(0, 0, bottom), e + Vector3d(0, 0, bottom),
                                 e + Vector3d(0, 0, top), s + Vector3d(0, 0, top)},
                                colour});
    };
    for (std::size_t side = 0; side < 4; ++side) {
        const Vector3d& a = corners[side];
        const Vector3d& b = corners[(side + 1) % 4];
        // The wall ends behind its skirting: two edges in one place would let the floor shine through.
        const Vector3d foot(0, 0, 0.05);
        scene.panels.push_back({{a + foot, b + foot, b + up, a + up}, wall});
        patch(side, 0.0, (b - a).norm(), 0.0, 0.1, skirting);
    }
    Random random(static_cast<std::uint64_t>(p.clutter_seed));
    for (int i = 0; i < p.posters; ++i) {
        const std::size_t side = static_cast<std::size_t>(i) % 4;
        const double length = (corners[(side + 1) % 4] - corners[side]).norm();
        const double width = random.uniform(0.3, std::min(1.6, 0.5 * length));
        const double from = random.uniform(0.0, length - width);
        const bool stands = random.uniform() < 0.4;  // a cupboard, a table top
        const double bottom = stands ? 0.0 : random.uniform(0.5, 1.4);
        const double top = std::min(p.room_height, bottom + random.uniform(0.3, 1.1));
        patch(side, from, from + width, bottom, top, draw_colour(random));
    }
}

void add_goals(Scene& scene, const SceneParameters& p) {
    const Field& field = scene.field;
    const Rgb colour = field.goal_colour == "white" ? rgb_parameter("white_goal", p.white_goal)
                                                    : rgb_parameter("yellow_goal", p.yellow_goal);
    scene.posts = goalposts(field);
    for (const Cylinder& post : scene.posts) scene.tubes.push_back({post, colour});
    for (const Cylinder& bar : crossbars(field)) scene.tubes.push_back({bar, colour});
    if (!p.goal_frame || field.goal_depth <= 0.0) return;
    const Rgb frame{205, 206, 204};
    constexpr double radius = 0.008;  // m
    for (const double side : {-1.0, 1.0}) {
        const double back = side * (field.length / 2.0 + field.goal_depth);
        const double y = field.goal_width / 2.0;
        for (const double s : {-1.0, 1.0}) {
            const Vector3d corner(back, s * y, radius);
            scene.tubes.push_back(
                {between({side * field.length / 2.0, s * y, field.goal_height}, corner, radius), frame});
            scene.tubes.push_back(
                {between({side * field.length / 2.0, s * y, radius}, corner, radius), frame});
        }
        scene.tubes.push_back({between({back, -y, radius}, {back, y, radius}, radius), frame});
    }
}

void add_spectators(Scene& scene, const SceneParameters& p) {
    Random random(static_cast<std::uint64_t>(p.clutter_seed) + 0x5eedULL);
    for (int i = 0; i < p.spectators; ++i) {
        const double out = p.room_margin * random.uniform(0.35, 0.75);
        const double x = scene.layout.carpet_half_length + out;
        const double y = scene.layout.carpet_half_width + out;
        const double along = random.uniform(-0.9, 0.9);
        const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
        const Vector3d feet =
            i % 2 == 0 ? Vector3d(along * x, side * y, 0) : Vector3d(side * x, along * y, 0);
        const double hips = random.uniform(0.8, 0.95);
        const Rgb trousers = clutter_colours[random.index(2) == 0 ? 0 : 5];
        const Rgb shirt = draw_colour(random);
        const double gap = random.uniform(0.09, 0.16);
        scene.tubes.push_back(
            {between(feet + Vector3d(-gap, gap, 0), feet + Vector3d(0, 0, hips), 0.08), trousers});
        scene.tubes.push_back(
            {between(feet + Vector3d(gap, -gap, 0), feet + Vector3d(0, 0, hips), 0.08), trousers});
        scene.tubes.push_back(
            {between(feet + Vector3d(0, 0, hips), feet + Vector3d(0, 0, hips + 0.6), 0.18), shirt});
        scene.tubes.push_back(
            {between(feet + Vector3d(0, 0, hips + 0.62), feet + Vector3d(0, 0, hips + 0.85), 0.09),
             {178, 132, 116}});
    }
}

}  // namespace

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
        return between({feet[right].x(), feet[right].y(), field.goal_height},
                       {feet[left].x(), feet[left].y(), field.goal_height}, field.post_diameter / 2.0);
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
    add_room(scene, p);
    add_goals(scene, p);
    add_spectators(scene, p);
    return scene;
}

}  // namespace goalmouth
