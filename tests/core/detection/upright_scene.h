#pragma once

#include "core/detection/post.h"
#include "core/extraction/candidates.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/geometry/cylinder.h"

#include <functional>
#include <numbers>
#include <optional>
#include <vector>

namespace goalmouth::test {

inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr int spacing = 4;  // px, of scan-lines

/// A camera on a robot that stands in the origin of the ground and looks along x.
struct Robot {
    double height = 0.42;
    double roll = 0.0, pitch = 0.05;  // rad
    Intrinsics camera;

    Eigen::Isometry3d T_BC() const { return camera_in_body(height, roll, pitch); }
    CameraPose told(double roll_error = 0.0, double pitch_error = 0.0) const {
        CameraPose pose;
        pose.T_BC = camera_in_body(height, roll + roll_error, pitch + pitch_error);
        pose.covariance.diagonal() << 0.0, 0.0, 1e-4, 3e-4, 3e-4, 3e-4;
        return pose;
    }
};

/// A thing of the post's colour: upright, round.
Cylinder post_at(double ahead, double left, double top = 0.95, double radius = 0.05);

/// What a row of one thing shows; tests change it.
struct Row {
    double left, right;
    bool shows = true, left_edge = true, right_edge = true;
};
using Change = std::function<void(Row& row, double from_top)>;  // 0 at the top … 1 at the base

Candidates empty_frame(const Intrinsics& camera);

/// Adds what scan-lines see of it, by the geometry of its silhouette's straight edges.
void add(Candidates& c, const Robot& robot, const Cylinder& thing, const Change& change = {});

/// What UprightDetector finds.
std::vector<Post> detect(const Candidates& c, const Robot& robot, const std::optional<CameraPose>& pose);

}  // namespace goalmouth::test
