#pragma once

#include "core/geometry/camera.h"
#include "core/geometry/cylinder.h"
#include "core/geometry/pose2.h"
#include "core/simulation/scene.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// What a perfect detector would see of one post.
struct TruePost {
    int id = 0;                // as Field::posts()
    Eigen::Vector2d position;  // m, axis on the ground, frame W
    double distance_m = 0.0;   // m, camera centre to the axis, along the ground
    double bearing_rad = 0.0;  // of the silhouette's middle: atan(−x/z) of the mean of its four ends; + left
    CylinderEdges edges;   // px, undistorted, ground to upper edge of the crossbar; may lie outside the image
    double inside = 0.0;   // share of the silhouette inside the image, 0…1
    double visible = 0.0;  // share of the silhouette inside the image and not hidden, 0…1
};

/// The truth about one frame.
struct Truth {
    Pose2 robot;  // frame B in W
    Eigen::Isometry3d T_WC = Eigen::Isometry3d::Identity();
    Eigen::Vector2d ball = Eigen::Vector2d::Zero();  // m, frame W
    std::vector<TruePost> posts;                     // every post in front of the camera
};

/// Posts that stand and of which a part is in front of the camera, the camera not inside one of them. Hidden
/// means hidden by the ball or any tube: another post, a bar, a strut, a robot, a person; sampled on a grid
/// across the silhouette, so `inside` and `visible` are good to about a hundredth.
std::vector<TruePost> true_posts(const Scene& scene, const Intrinsics& camera, const Eigen::Isometry3d& T_WC);

/// Which points on the side of a post [m, W] something hides from the camera: what can hide is as above.
/// `post`: as Field::posts(). All where the camera is inside the post.
std::vector<bool> hidden_points(const Scene& scene, const Eigen::Isometry3d& T_WC, std::size_t post,
                                std::span<const Eigen::Vector3d> points);

/// Distance along the ray from…from + t·direction (any length, t > 0) to a ball, as t; nothing where it
/// misses.
std::optional<double> hit(const Ball& ball, const Eigen::Vector3d& from, const Eigen::Vector3d& direction);

}  // namespace goalmouth
