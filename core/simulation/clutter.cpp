#include "core/simulation/clutter.h"

#include "core/random/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace goalmouth {
namespace {

using Eigen::Vector3d;

/// Cloth, paper and wood as halls have them; nothing of a goal's yellow or a carpet's green.
constexpr std::array<Rgb, 12> quiet_colours = {{{34, 52, 110},
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

/// Any hue, from grey to full colour, from dark to bright.
Rgb draw_any_colour(Random& random) {
    const double hue = random.uniform(0.0, 6.0);
    const double saturation = random.uniform();
    const double value = random.uniform(30.0, 245.0);
    const auto channel = [&](double at) {
        const double turn = std::fmod(hue + at, 6.0);
        const double share = std::clamp(std::min(turn, 4.0 - turn), 0.0, 1.0);
        return static_cast<float>(value * (1.0 - saturation * share));
    };
    return {channel(5.0), channel(3.0), channel(1.0)};
}

Rgb draw_colour(Random& random, bool any) {
    return any ? draw_any_colour(random) : quiet_colours[random.index(quiet_colours.size())];
}

/// As another maker's paint or dye of the same name: brighter or darker, and a little off in each channel.
Rgb draw_like(Random& random, const Rgb& colour) {
    const double brightness = random.uniform(0.88, 1.06);
    const auto channel = [&](float level) {
        const double varied = brightness * static_cast<double>(level) + random.uniform(-8.0, 8.0);
        return static_cast<float>(std::clamp(varied, 0.0, 255.0));
    };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

void add(Scene& scene, const Cylinder& cylinder, const Rgb& colour) {
    scene.tubes.push_back({cylinder, colour, Tube::Of::hall});
}

/// Somewhere between carpet and walls; every other one along the long sides.
Vector3d draw_place(Random& random, const Scene& scene, const SceneParameters& p, int number) {
    const double out = p.room_margin * random.uniform(0.35, 0.75);
    const double x = scene.layout.carpet_half_length + out;
    const double y = scene.layout.carpet_half_width + out;
    const double along = random.uniform(-0.9, 0.9);
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    return number % 2 == 0 ? Vector3d(along * x, side * y, 0) : Vector3d(side * x, along * y, 0);
}

struct Clothes {
    Rgb trousers;
    Rgb shirt;
};

void add_person(Scene& scene, const Vector3d& feet, double hips, double gap, const Clothes& clothes) {
    const Vector3d hip = feet + Vector3d(0, 0, hips);
    const auto up = [&](double height) { return Vector3d(hip + Vector3d(0, 0, height)); };
    add(scene, cylinder_between(feet + Vector3d(-gap, gap, 0), hip, 0.08), clothes.trousers);
    add(scene, cylinder_between(feet + Vector3d(gap, -gap, 0), hip, 0.08), clothes.trousers);
    add(scene, cylinder_between(hip, up(0.6), 0.18), clothes.shirt);
    add(scene, cylinder_between(up(0.62), up(0.85), 0.09), {178, 132, 116});
}

}  // namespace

void add_posters(Scene& scene, const Room& room, const SceneParameters& p) {
    Random random(static_cast<std::uint64_t>(p.clutter_seed));
    for (int i = 0; i < p.posters; ++i) {
        const std::size_t side = static_cast<std::size_t>(i) % 4;
        const double length = room.length(side);
        const double width = random.uniform(0.3, std::min(1.6, 0.5 * length));
        const double from = random.uniform(0.0, length - width);
        const bool stands = random.uniform() < 0.4;  // a cupboard, a table top
        const double bottom = stands ? 0.0 : random.uniform(0.5, 1.4);
        const double top = std::min(room.height(), bottom + random.uniform(0.3, 1.1));
        const Rgb colour = draw_colour(random, p.any_colour);
        // A low room has walls that end below where this one would hang.
        if (bottom < top) scene.panels.push_back(room.patch(side, from, from + width, bottom, top, colour));
    }
}

void add_spectators(Scene& scene, const SceneParameters& p) {
    Random random(static_cast<std::uint64_t>(p.clutter_seed) + 0x5eedULL);
    for (int i = 0; i < p.spectators; ++i) {
        const Vector3d feet = draw_place(random, scene, p, i);
        const double hips = random.uniform(0.8, 0.95);
        Clothes clothes;
        clothes.trousers =
            p.any_colour ? draw_any_colour(random) : quiet_colours[random.index(2) == 0 ? 0 : 5];
        clothes.shirt = draw_colour(random, p.any_colour);
        add_person(scene, feet, hips, random.uniform(0.09, 0.16), clothes);
    }
}

void add_distractors(Scene& scene, const Room& room, const SceneParameters& p, const Rgb& goals) {
    Random random(static_cast<std::uint64_t>(p.clutter_seed) + 0xd157ULL);
    for (int i = 0; i < p.distractors; ++i) {
        const Rgb colour = draw_like(random, goals);
        if (i % 3 == 0) {
            const Vector3d foot = draw_place(random, scene, p, i / 3);
            const double height = random.uniform(0.9, 2.2);
            const double sideways = random.uniform(-0.15, 0.15);
            const double ahead = random.uniform(-0.15, 0.15);
            const Vector3d lean(ahead, sideways, 1.0);
            add(scene, cylinder_between(foot, foot + height * lean, random.uniform(0.025, 0.07)), colour);
        } else if (i % 3 == 1) {
            const std::size_t side = random.index(4);
            const double width = random.uniform(0.1, 0.6);
            const double from = random.uniform(0.0, std::max(0.0, room.length(side) - width));
            const double bottom = random.uniform(0.0, 0.6);
            const double top = std::min(room.height(), bottom + random.uniform(0.5, 2.0));
            scene.panels.push_back(room.patch(side, from, from + width, bottom, top, colour));
        } else {
            const Vector3d feet = draw_place(random, scene, p, i / 3 + 1);
            const double hips = random.uniform(0.8, 0.95);
            const Rgb trousers = draw_colour(random, p.any_colour);
            add_person(scene, feet, hips, random.uniform(0.09, 0.16), {trousers, colour});
        }
    }
}

}  // namespace goalmouth
