#pragma once

#include "core/evaluation/reference_post.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "tools/evaluate/images_poses.h"

#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace goalmouth {

/// Which of the field's goalposts an outlined one is, by where the robot stood.
struct PlacedPost {
    std::size_t goalpost = 0;      // place in Field::posts()
    double distance = 0.0;         // m, along the ground, from the robot's feet to the post's axis
    double direction_error = 0.0;  // rad: bearing in the picture less that by the robot's place
};

/// σ of the direction in which a robot looks that a person has put down by eye: ±5° is what the people who
/// did it for nao_uva_2013 say.
inline constexpr double placement_sigma = 5.0 * std::numbers::pi / 180.0;
/// A goalpost farther from an outline's direction than so many σ is not the one it shows.
inline constexpr double placement_gate = 3.0;

/// Each outline (px, in a picture of `camera`) gets the goalpost nearest in direction, heading + head yaw +
/// bearing, of those the camera can see from there: one each, the least sum of squares (which keeps them
/// in order), none beyond the gate. The bearing is that of the outline's middle, as a detector states it;
/// with a camera tilted by 15° it is 1° off at the border of a picture 60° wide, little beside the
/// placement's σ.
std::vector<std::optional<PlacedPost>> place_posts(std::span<const ReferencePost> outlines,
                                                   const Intrinsics& camera, const RobotPlace& place,
                                                   const Field& field);

}  // namespace goalmouth
