#include "core/simulation/robot.h"

#include "core/random/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {
namespace {

using Eigen::Vector3d;

constexpr Rgb aluminium{128, 130, 134};
constexpr Rgb plastic{44, 44, 48};
constexpr double model_height = 0.4545;  // m

struct Link {
    Vector3d from, to;  // m: x ahead, y left, z up from the ground under the standing robot
    double radius;
    Rgb colour;
};

std::vector<Link> links(const Rgb& jersey) {
    std::vector<Link> result;
    const double ankle = 0.0335, knee = ankle + 0.093, hip = knee + 0.093;
    const double shoulder = hip + 0.1222;
    for (const double side : {1.0, -1.0}) {
        const double leg = side * 0.037;
        const double arm = side * 0.082;
        for (const double half : {-0.0165, 0.0165})
            result.push_back({{-0.046, leg + half, 0.0165}, {0.058, leg + half, 0.0165}, 0.0165, plastic});
        result.push_back({{0.0, leg, ankle}, {0.01, leg, knee}, 0.024, aluminium});
        result.push_back({{0.01, leg, knee}, {0.0, leg, hip}, 0.026, plastic});
        result.push_back({{0.0, arm, shoulder}, {0.0, 1.1 * arm, shoulder - 0.06}, 0.021, plastic});
        result.push_back({{0.0, 1.1 * arm, shoulder - 0.06}, {0.04, arm, shoulder - 0.18}, 0.018, aluminium});
    }
    result.push_back({{0.0, -0.055, hip + 0.02}, {0.0, 0.055, hip + 0.02}, 0.03, plastic});
    // Parts of the trunk reach into each other, or what is behind would shine through where they meet.
    result.push_back({{0.0, 0.0, hip + 0.03}, {0.0, 0.0, hip + 0.07}, 0.055, plastic});
    result.push_back({{0.0, 0.0, hip + 0.065}, {0.0, 0.0, shoulder - 0.015}, 0.055, jersey});
    result.push_back({{0.0, 0.0, shoulder - 0.02}, {0.0, 0.0, shoulder + 0.022}, 0.055, plastic});
    result.push_back({{0.0, 0.0, shoulder + 0.034}, {0.0, 0.0, model_height}, 0.045, aluminium});
    return result;
}

double lowest(const Cylinder& c) {
    return std::min(c.base.z(), c.top().z()) -
           c.radius * std::sqrt(std::max(0.0, 1.0 - c.axis.z() * c.axis.z()));
}

}  // namespace

void add_robot(Scene& scene, const RobotPlace& place) {
    const double scale = place.height / model_height;
    Eigen::Isometry3d T_WR = on_ground(place.pose);
    if (place.fallen) {
        // Its up becomes ahead, its front the ground.
        T_WR.linear() = T_WR.linear() * Eigen::AngleAxisd(std::numbers::pi / 2.0, Vector3d::UnitY());
        T_WR.translation() -= T_WR.linear() * Vector3d(0.0, 0.0, place.height / 2.0);
    }
    const std::size_t first = scene.tubes.size();
    for (const Link& link : links(place.jersey))
        scene.tubes.push_back({cylinder_between(T_WR * Vector3d(scale * link.from),
                                                T_WR * Vector3d(scale * link.to), scale * link.radius),
                               link.colour, Tube::Of::robot});
    double ground = scene.tubes[first].cylinder.base.z();
    for (std::size_t i = first; i < scene.tubes.size(); ++i)
        ground = std::min(ground, lowest(scene.tubes[i].cylinder));
    for (std::size_t i = first; i < scene.tubes.size(); ++i) scene.tubes[i].cylinder.base.z() -= ground;
}

void add_robots(Scene& scene, const SceneParameters& p) {
    constexpr double room = 0.6;           // m, about posts and robots
    constexpr double room_for_ball = 0.3;  // m
    constexpr int most_tries = 1000;       // for each robot: beyond them the field is full
    Random random(static_cast<std::uint64_t>(p.clutter_seed) + 0x90b07ULL);
    std::vector<Eigen::Vector2d> taken;
    for (const Eigen::Vector2d& foot : scene.field.posts()) taken.push_back(foot);
    for (int i = 0; i < p.robots; ++i) {
        RobotPlace place;
        place.fallen = random.uniform() < 0.2;
        place.jersey = random.index(2) == 0 ? Rgb{24, 150, 176} : Rgb{184, 40, 120};
        place.height = random.uniform(0.42, 0.5);
        place.pose.theta = random.uniform(-std::numbers::pi, std::numbers::pi);
        for (int tries = 0; tries < most_tries; ++tries) {
            place.pose.x = 0.5 * scene.field.length * random.uniform(-1.0, 1.0);
            place.pose.y = 0.5 * scene.field.width * random.uniform(-1.0, 1.0);
            const Eigen::Vector2d here = place.pose.position();
            const auto near = [&](const Eigen::Vector2d& other) { return (other - here).norm() <= room; };
            if (std::any_of(taken.begin(), taken.end(), near) ||
                (scene.ball.centre.head<2>() - here).norm() <= room_for_ball)
                continue;
            taken.push_back(here);
            add_robot(scene, place);
            break;
        }
    }
}

}  // namespace goalmouth
