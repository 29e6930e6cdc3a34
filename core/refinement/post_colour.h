#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/camera_response.h"
#include "core/refinement/refinement_parameters.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Where a post is supposed to be: its edges as straight lines in the picture [px].
struct RoughOutline {
    Eigen::Vector2d left_top, left_base, right_top, right_base;
    int first_row = 0, last_row = 0;  // inside the picture

    double left(double row) const { return along(left_top, left_base, row); }
    double right(double row) const { return along(right_top, right_base, row); }
    double width() const;  // px along the rows, at the middle

  private:
    static double along(const Eigen::Vector2d& top, const Eigen::Vector2d& base, double row);
};

/// A post's own colour, and how it changes where the post is lit more or less.
///
/// Light that falls on it at any angle, shadow or shine moves a surface's colour along one line in (Y, Cb,
/// Cr): with all of red, green and blue in one proportion, also after a camera's gamma curve, through black.
/// What is square to that line is the same all over the post: that is what tells it from the background. With
/// shade direction d and a pixel's noise Σ, what a difference e of colours tells after shading is left out
/// (fitted with any strength) is eᵀMe,
///     M = Σ⁻¹ − Σ⁻¹ d dᵀ Σ⁻¹ / (dᵀΣ⁻¹d),   M·d = 0.
/// The weights that tell a background at offset e from the post best are w = M·e. Grey posts have d =
/// (1,0,0): M then leaves chroma alone.
struct PostColour {
    static constexpr float too_dark = 1e9F;  // for a difference

    CameraResponse response = CameraResponse::linear;  // what pixels are read as, here and compared with it
    PairColour mean = PairColour::Zero();
    Eigen::Vector3f shade = Eigen::Vector3f::UnitX();        // d, first element 1
    Eigen::Matrix3f noise = Eigen::Matrix3f::Identity();     // Σ of a pair
    Eigen::Matrix3f contrast = Eigen::Matrix3f::Identity();  // M
    float darkest = 0.0F;                                    // luma: what is darker may be of any colour
    float spread = 1.0F;  // of the post's own pixels: mean of ½·eᵀMe; 1 with nothing but noise
    int samples = 0;      // pairs of that colour
    int looked_at = 0;    // pairs

    /// eᵀMe of a colour; `too_dark` of one too dark to tell: black lies on every shade's line.
    float difference(const PairColour& colour) const {
        if (colour[0] < darkest) return too_dark;
        const Eigen::Vector3f e = colour - mean;
        return e.dot(contrast * e);
    }
};

/// M from the noise and the shade direction.
Eigen::Matrix3f contrast_matrix(const Eigen::Matrix3f& noise, const Eigen::Vector3f& shade);

/// Estimates a post's colour from inside its rough outline: the commonest ratio of chroma to luma there, so
/// that people in front of it or edges that are off do not count; the shade direction from how its pixels
/// vary (noise discounted), where they hardly do from `black_level`. The noise is that between neighbouring
/// rows.
class PostColourEstimator {
  public:
    /// false where there are too few pixels of one colour.
    bool estimate(YuyvView image, const RoughOutline& outline, const RefinementParameters& parameters,
                  CameraResponse response, PostColour& colour);

  private:
    struct Sample {
        PairColour mean;        // of two rows
        PairColour difference;  // between them
        Eigen::Vector2f ratio;  // chroma per luma
    };
    std::vector<Sample> samples_;
};

}  // namespace goalmouth
