#pragma once

#include "core/geometry/pose2.h"
#include "core/simulation/colour.h"
#include "core/simulation/scene.h"

namespace goalmouth {

/// Where another robot stands or lies.
struct RobotPlace {
    Pose2 pose;  // frame W: standing, its middle; fallen, the middle of what lies there. Ahead is where
                 // it looks, or where its head points
    bool fallen = false;   // on its front
    double height = 0.45;  // m, of the standing robot
    Rgb jersey{};          // colour of the band about its chest
};

/// A humanoid of 17 cylinders in the proportions of a DARwIn-OP: links of its legs and arms, distances of its
/// joints and its height of 0.4545 m as its makers state them; thicknesses are ours.
void add_robot(Scene& scene, const RobotPlace& place);

/// SceneParameters::robots of them, anywhere within the lines, every fifth fallen on average, in cyan or
/// magenta; farther than 0.6 m from every post of the field and from each other, and clear of the ball.
void add_robots(Scene& scene, const SceneParameters& parameters);

}  // namespace goalmouth
