#pragma once

#include "core/parameters/parameters.h"

#include <array>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// Pinhole camera with radial and tangential distortion (OpenCV's model), for images of one size.
/// Frame C: x right, y down, z forward. Pixel (0,0) is the centre of the top-left pixel.
struct Intrinsics {
    int width = 640;                     // px
    int height = 480;                    // px
    double fx = 554.26;                  // px; the paper's γ_x: 640 / (2 tan 30°) for the Logitech C905
    double fy = 554.26;                  // px
    double cx = 319.5;                   // px
    double cy = 239.5;                   // px
    std::array<double, 5> distortion{};  // k1, k2, p1, p2, k3

    bool operator==(const Intrinsics&) const = default;
    bool has_distortion() const;
};

template <class Visitor>
void describe_parameters(Visitor& v, Intrinsics& p) {
    v("width", p.width, Range{1, 16384}, "px", "image width the calibration holds for");
    v("height", p.height, Range{1, 16384}, "px", "image height the calibration holds for");
    v("fx", p.fx, Range{1, 1e6}, "px", "focal length along x");
    v("fy", p.fy, Range{1, 1e6}, "px", "focal length along y");
    v("cx", p.cx, Range{-1e5, 1e5}, "px", "principal point, x (0 is the centre of the leftmost pixel)");
    v("cy", p.cy, Range{-1e5, 1e5}, "px", "principal point, y");
    v("k1", p.distortion[0], Range{-10, 10}, "1", "radial distortion, r²");
    v("k2", p.distortion[1], Range{-10, 10}, "1", "radial distortion, r⁴");
    v("p1", p.distortion[2], Range{-1, 1}, "1", "tangential distortion");
    v("p2", p.distortion[3], Range{-1, 1}, "1", "tangential distortion");
    v("k3", p.distortion[4], Range{-10, 10}, "1", "radial distortion, r⁶");
}

/// The same camera delivering images of another size by scaling. Pixels scale about the image's corner, which
/// lies half a pixel before the first one's centre: x becomes (x + ½)·s − ½.
Intrinsics scaled_to(const Intrinsics& camera, int width, int height);

/// Centred camera without distortion from its horizontal field of view [rad], 0 < fov < π.
Intrinsics from_horizontal_fov(int width, int height, double fov);

/// Pixel of a point given in frame C [m]; nothing where z ≤ 0.
std::optional<Eigen::Vector2d> project(const Intrinsics& camera, const Eigen::Vector3d& point_C);

/// Distorts normalised image coordinates (x/z, y/z), then scales to pixels.
Eigen::Vector2d pixel_from_normalised(const Intrinsics& camera, const Eigen::Vector2d& normalised);

/// Its derivative: how the pixel moves with the normalised coordinates.
Eigen::Matrix2d pixel_change(const Intrinsics& camera, const Eigen::Vector2d& normalised);

/// Whether the lens model says nothing about a point: at its normalised coordinates, or on the way there from
/// the optical axis, points farther out come to lie nearer to the principal point again. What lies there can
/// seem to be inside the image.
bool folds_back(const Intrinsics& camera, const Eigen::Vector2d& normalised);

/// Undistorted normalised image coordinates (x/z, y/z) of a pixel; fixed-point iteration, to 1e-12 for lenses
/// whose distortion is monotone over the image.
Eigen::Vector2d normalised_from_pixel(const Intrinsics& camera, const Eigen::Vector2d& pixel);

/// Where the ray through a pixel meets the ground plane z = 0 of frame W, given T_WC; nothing at or above the
/// horizon.
std::optional<Eigen::Vector2d> ground_point(const Intrinsics& camera, const Eigen::Isometry3d& T_WC,
                                            const Eigen::Vector2d& pixel);

/// T_BC of a camera `height` [m] above the ground that looks along body x, then is turned left by `yaw`, down
/// by `pitch` and clockwise about its own axis (as the camera sees it, the image's content turns
/// anticlockwise) by `roll` [rad].
Eigen::Isometry3d camera_in_body(double height, double roll, double pitch, double yaw = 0.0);

}  // namespace goalmouth
