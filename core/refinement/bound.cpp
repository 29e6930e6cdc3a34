#include "core/refinement/bound.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace goalmouth {
namespace {

constexpr double pixel_box = 1.0 / 12.0;  // px², variance of a pixel's square along any normal
constexpr double rounding = 1.0 / 12.0;   // of a whole level

double step(double x) {
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// aᵀΣ⁻¹a in the complement of the post's colour, for one pair of pixels of which the post covers a share.
double squared_contrast(const EdgeLook& look, double covered) {
    Eigen::Matrix3d noise = 0.5 * (covered * look.post_noise + (1.0 - covered) * look.background_noise);
    noise.diagonal() += Eigen::Vector3d(0.5 * rounding, rounding, rounding);
    const Eigen::LLT<Eigen::Matrix3d> solver(noise);
    const Eigen::Vector3d contrast = solver.matrixL().solve(look.post - look.background);
    const Eigen::Vector3d own = solver.matrixL().solve(look.post);
    const double size = own.squaredNorm();
    if (!(size > 0.0)) return contrast.squaredNorm();
    return (contrast - contrast.dot(own) / size * own).squaredNorm();
}

/// How the pixel's signed place n·d grows from pixel to pixel, d the ray (x, y, 1) of a pixel.
Eigen::Vector2d gradient(const Intrinsics& camera, const Eigen::Vector3d& plane,
                         const Eigen::Vector2d& normalised) {
    Eigen::Matrix2d pixels_per_unit;  // ∂pixel/∂(x, y)
    if (camera.has_distortion()) {
        constexpr double step = 1e-5;
        for (int i = 0; i < 2; ++i) {
            const Eigen::Vector2d off = step * Eigen::Vector2d::Unit(i);
            pixels_per_unit.col(i) = (pixel_from_normalised(camera, normalised + off) -
                                      pixel_from_normalised(camera, normalised - off)) /
                                     (2.0 * step);
        }
    } else {
        pixels_per_unit << camera.fx, 0.0, 0.0, camera.fy;
    }
    return pixels_per_unit.inverse().transpose() * plane.head<2>();
}

}  // namespace

double PostBound::distance_sigma() const {
    return std::sqrt(covariance(0, 0));
}

double PostBound::turn_sigma() const {
    return std::sqrt(covariance(1, 1));
}

Eigen::Matrix3d ycbcr_noise(const Eigen::Vector3d& rgb_variance) {
    Eigen::Matrix3d from_rgb;
    from_rgb << 0.299, 0.587, 0.114, -0.168736, -0.331264, 0.5, 0.5, -0.418688, -0.081312;
    return from_rgb * rgb_variance.asDiagonal() * from_rgb.transpose();
}

double contrast_to_noise(const EdgeLook& look) {
    return std::sqrt(squared_contrast(look, 0.5));
}

double edge_information(const EdgeLook& look, const Eigen::Vector2d& normal) {
    // Gauss and Hermite's places and weights for the mean over a normal distribution.
    constexpr std::array<double, 5> places = {-2.8569700138728, -1.3556261799743, 0.0, 1.3556261799743,
                                              2.8569700138728};
    constexpr std::array<double, 5> weights = {0.0112574113277207, 0.2220759220056126, 0.5333333333333333,
                                               0.2220759220056126, 0.0112574113277207};
    const double across = normal.x() * normal.x();
    const double variance = look.blur * look.blur + pixel_box;
    const double energy =
        (1.0 + std::exp(-0.25 * across / variance)) / (4.0 * std::sqrt(std::numbers::pi * variance));  // ∫g²
    // g² is about normal with half the profile's variance: t = place · σ_b / √2.
    double contrast = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i)
        contrast += weights[i] * squared_contrast(look, step(places[i] / std::numbers::sqrt2));
    constexpr double pairs_per_pixel = 0.5;
    return pairs_per_pixel * energy * contrast;
}

std::optional<PostBound> post_bound(const Intrinsics& camera, const CylinderSilhouette& post,
                                    const std::vector<EdgePiece>& left, const std::vector<EdgePiece>& right,
                                    double direction_sigma) {
    const double sine = std::sin(post.half_angle);
    const double cosine = std::cos(post.half_angle);
    const Eigen::Vector3d ahead = (post.left_plane + post.right_plane) / (2.0 * sine);
    const Eigen::Vector3d leftwards = (post.right_plane - post.left_plane) / (2.0 * cosine);
    const Eigen::Vector3d up = ahead.cross(leftwards);
    const double angle_rate = -std::tan(post.half_angle) / post.axis_distance;  // dα/dD

    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    const auto add = [&](const std::vector<EdgePiece>& pieces, const Eigen::Vector3d& plane, double side) {
        Eigen::Matrix<double, 3, 4> rates;
        rates.col(0) = angle_rate * (cosine * ahead + side * sine * leftwards);
        rates.col(1) = up.cross(plane);
        rates.col(2) = ahead.cross(plane);
        rates.col(3) = leftwards.cross(plane);
        for (const EdgePiece& piece : pieces) {
            const Eigen::Vector2d normalised = normalised_from_pixel(camera, piece.pixel);
            const Eigen::Vector2d slope = gradient(camera, plane, normalised);
            const Eigen::Vector4d shift = rates.transpose() * normalised.homogeneous() / slope.norm();
            information +=
                piece.length * edge_information(piece.look, slope.normalized()) * shift * shift.transpose();
        }
    };
    add(left, post.left_plane, 1.0);
    add(right, post.right_plane, -1.0);

    PostBound bound;
    const bool known = direction_sigma == 0.0;
    if (!known) {
        const double prior = 1.0 / (direction_sigma * direction_sigma);
        information(2, 2) += prior;
        information(3, 3) += prior;
    }
    // The vertical's errors, taken out of what the edges tell: Schur's complement.
    Eigen::Matrix2d own = information.topLeftCorner<2, 2>();
    if (!known) {
        const Eigen::Matrix2d mixed = information.topRightCorner<2, 2>();
        own -= mixed * information.bottomRightCorner<2, 2>().inverse() * mixed.transpose();
    }
    // Metres against radians: judged by the correlation, which knows no units.
    constexpr double least = 1e-9;
    const double scale = own(0, 0) * own(1, 1);
    if (!(scale > 0.0) || !(own.determinant() > least * scale)) return std::nullopt;
    bound.covariance = own.inverse();
    return bound;
}

}  // namespace goalmouth
