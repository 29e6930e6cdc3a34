#pragma once

#include "core/geometry/camera.h"
#include "core/geometry/cylinder.h"

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// The Cramér–Rao bound of a post's distance and direction: how well its two edges can tell them at all, to
/// whoever looks for them without bias. Used to judge PostRefiner, not by it.
///
/// One edge. Its shift s along its normal moves the levels of the pixels near it: with a = post − background
/// and the edge's profile c(t) at t pixels from it, the level is background + a c(t − s), and its derivative
/// −a g(t), g = c′. Samples with noise covariance Σ carry the Fisher information
///
///     I = Σ_samples g(t)² aᵀΣ⁻¹a  =  L ρ ∫ g(t)² aᵀΣ⁻¹a dt
///
/// for a length L of edge and ρ samples per square pixel: the sum over an area does not know at which angle
/// the edge crosses it. Tilt changes how long an edge is in the picture, not what a pixel of it tells. For
/// g = N(0, σ_b²), ∫g² = 1/(2√π σ_b), and with σ_w² = 2/I for the two edges of a width
///
///     σ_w = (σ_n/A) √(4√π σ_b/L),      σ_D = D²/(w γ) σ_w                                (FACTS, section 2)
///
/// where σ_n/A is 1/√(ρ aᵀΣ⁻¹a), and the second holds for an upright post far away in the image's middle.
///
/// Shading. A round post is lit unevenly: a pixel of it has the colour m·p, p the post's (Y, Cb − 128,
/// Cr − 128), with a brightness m of its own that nobody knows. What an unknown along c·p can imitate does
/// not count; left is the contrast in the complement of p, in the metric of the noise:
///
///     aᵀΣ⁻¹a − (aᵀΣ⁻¹p)²/(pᵀΣ⁻¹p),
///
/// the same for all m: it is the background's part that is not of the post's colour.
///
/// Sampling, 4:2:2. Each pixel has its Y, each pair of pixels along the row one Cb and Cr, the mean of both.
/// An unknown m in each of two pixels uses up what two of the four values say; the other two are differences
/// of the pair's chroma and of its mean luma. So the pair is the sample: ρ = ½,
///
///     Σ = ½ (covariance of one pixel's (Y, Cb, Cr)) + diag(1/24, 1/12, 1/12),
///
/// the last of rounding to whole levels (variance 1/12; luma's is halved by the mean of two).
///
/// Blur. The light of a pixel is the mean over its square, which adds a variance of 1/12 px² along any
/// normal: that is all luma has beside the optics. The mean of two pixels in a row adds ½·½ = ¼ n_x² for a
/// normal n: ¼ across an upright edge, none across a level one. So for the pair σ_b² = blur² + 1/12 + n_x²/4,
/// and, because two points are not a Gaussian, with s² = blur² + 1/12
///
///     ∫g² = (1 + exp(−n_x²/(4 s²))) / (4√π s).
///
/// Noise that grows with light is taken as it is along the profile. Not counted: what the noise's own change
/// across the edge tells (small), and that blur and levels are not known beforehand. With a blur of 0.85 px
/// levels told by 12 px on either side cost 18 % more in variance, and 40 % in posts 9 px wide, which have
/// fewer inside.
///
/// Both edges. n_l, n_r are the planes through the camera that touch the post, h and l unit vectors towards
/// the axis and to its left, α = asin(r/D):  n = sin α h ∓ cos α l. With parameters θ = (D, ψ, ε_1, ε_2), ψ a
/// turn about the post's direction to the left, ε small turns about h (slant in the picture) and l (lean in
/// depth), and the ray d through a place on the edge, that place moves along its normal by
///
///     −(∂n/∂θ · d) / |∇(n·d)| px,   ∂n/∂D = (cos α h ± sin α l) (−tan α/D),   ∂n/∂ψ = u × n,  u = h × l,
///
/// and F = Σ ∫ (…)(…)ᵀ dI over both edges. That is the exact derivative of D = r / sin(½∠(n_l, n_r)), near
/// and far, upright or not, on the axis or off it, through any lens. The bound is F⁻¹: with the vertical
/// known over (D, ψ), with a σ of its own over all four.
struct PostBound {
    Eigen::Matrix2d covariance;  // of (D [m], ψ [rad])

    double distance_sigma() const;  // m, of the distance from the camera square to the axis
    double turn_sigma() const;      // rad, of the direction about the axis
};

/// What both sides of a short piece of an edge look like. Colours are (Y, Cb − 128, Cr − 128) without noise,
/// noise the covariance of one pixel's, before pairs of chroma are averaged and levels rounded.
struct EdgeLook {
    Eigen::Vector3d post = Eigen::Vector3d::Zero();
    Eigen::Vector3d background = Eigen::Vector3d::Zero();
    Eigen::Matrix3d post_noise = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d background_noise = Eigen::Matrix3d::Identity();
    double blur = 0.85;  // px, σ across the edge, of optics and motion
};

/// A visible piece of an edge.
struct EdgePiece {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // its middle, in the picture as it is
    double length = 0.0;                              // px
    EdgeLook look;
};

/// Covariance of a pixel's (Y, Cb, Cr), BT.601 full range, from the variances of its red, green and blue.
Eigen::Matrix3d ycbcr_noise(const Eigen::Vector3d& rgb_variance);

/// Contrast of an edge against the noise of one pair of pixels, in the complement of the post's colour.
double contrast_to_noise(const EdgeLook& look);

/// Fisher information that a pixel's length of edge has of its own shift along `normal` (unit, in the
/// picture) [1/px² per px]. 0 where the background is of the post's colour, however bright.
double edge_information(const EdgeLook& look, const Eigen::Vector2d& normal);

/// The bound from the visible pieces of both edges. `direction_sigma` [rad]: of the vertical, about each
/// level axis; 0: known. Nothing where the pieces do not tell distance and direction, as with one edge alone.
std::optional<PostBound> post_bound(const Intrinsics& camera, const CylinderSilhouette& post,
                                    const std::vector<EdgePiece>& left, const std::vector<EdgePiece>& right,
                                    double direction_sigma = 0.0);

}  // namespace goalmouth
