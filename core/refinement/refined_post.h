#pragma once

#include "core/detection/post.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// An edge of a post as its pixels show it.
struct RefinedEdge {
    Eigen::Vector3d plane =
        Eigen::Vector3d::Zero();  // unit normal in frame C of the plane through the camera's
                                  // centre that touches the post here, towards the post
    int rows = 0;                 // rows that agree with it
};

/// What tells a distance; values as in distance_cue_t.
enum class DistanceCueKind : std::int8_t { width = 0, base = 1, crossbar = 2, goal = 3 };

/// The distance of a post as one thing alone tells it: from the camera to the axis, along the ground.
struct DistanceCue {
    DistanceCueKind kind = DistanceCueKind::width;
    double distance = 0.0;  // m
    double sigma = 0.0;     // m
};

/// A post measured anew in the picture's pixels.
struct RefinedPost {
    /// Flag `refined` set: corners, width, distance, bearing and covariance are measured anew. Else as the
    /// detector said it. An edge that was not measured has its missing flag; then there is no_distance, but
    /// bearing and its variance hold.
    Post post;
    std::string reason;    // why it is not refined, in words
    double quality = 0.0;  // 0…1
    int rows = 0;          // in which edges were looked for
    int iterations = 0;
    std::optional<RefinedEdge> left, right;
    std::optional<Eigen::Vector2d> base;  // px, where the middle line meets the ground, where that is seen
    std::optional<Eigen::Vector2d> top;   // px, its upper end, likewise
    std::vector<DistanceCue> cues;
};

}  // namespace goalmouth
