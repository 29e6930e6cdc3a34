#pragma once

#include "core/geometry/camera.h"

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// Circular cylinder: a goalpost, a crossbar. All in one frame [m].
struct Cylinder {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();   // where the axis starts
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit length
    double length = 1.0;
    double radius = 0.05;

    Eigen::Vector3d top() const { return base + length * axis; }
};

/// The two planes through the camera centre that touch a cylinder. Between them lies what the camera sees of
/// its side; the angle between them gives the distance of the axis: r / sin(½∠). Left and right are as seen
/// with the axis upright.
struct CylinderSilhouette {
    Eigen::Vector3d
        left_plane;  // unit normal in frame C, towards the cylinder: ray d is inside where left_plane·d ≥ 0
    Eigen::Vector3d right_plane;    // likewise
    Eigen::Vector3d left_contact;   // unit vector in the cylinder's frame, from the axis to the line the left
                                    // plane touches
    Eigen::Vector3d right_contact;  // likewise
    double axis_distance = 0.0;     // m, from the camera centre square to the axis
    double half_angle = 0.0;        // rad, asin(radius / axis_distance)
};

/// Silhouette of a cylinder given in frame W for a camera at T_WC; nothing where the camera is inside the
/// (endless) cylinder.
std::optional<CylinderSilhouette> silhouette(const Cylinder& cylinder, const Eigen::Isometry3d& T_WC);

/// The side edges of a cylinder in the undistorted image [px]: where its silhouette planes touch it, from end
/// to end.
struct CylinderEdges {
    Eigen::Vector2d left_base;
    Eigen::Vector2d left_top;
    Eigen::Vector2d right_base;
    Eigen::Vector2d right_top;
};

/// Ends may lie outside the image; a part closer than 1 cm before the camera's plane, or behind it, is cut
/// off. Nothing where no part of one of the edges is in front of the camera, or the camera is inside the
/// cylinder. Distortion is left out.
std::optional<CylinderEdges> project_edges(const Intrinsics& camera, const Eigen::Isometry3d& T_WC,
                                           const Cylinder& cylinder);

}  // namespace goalmouth
