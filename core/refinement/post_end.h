#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/edge_rows.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_silhouette.h"

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// An end of a post where its middle line of sight meets it: of the base the point of its rim nearest to the
/// camera, of the top the same, or seen from above the farthest.
struct PostEnd {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // px
    double slope = 0.0;   // tan of its elevation against the square to the axis, within the middle plane
    double sigma = 0.0;   // px, along the middle line
    double per_px = 0.0;  // slope per px along the middle line
    PairColour beyond = PairColour::Zero();  // what comes there
};

/// How ends are looked for.
struct PostEndSearch {
    double blur = 0.9;            // px, σ along the rows, as the edges show it
    double least_contrast = 3.0;  // RefinementParameters::least_contrast
    double floor = 0.05;          // px, sigma that does not shrink with more pixels
};

/// Measures the ends of a post to a fraction of a pixel from the pixels of its middle, about the row where
/// its colour ends.
///
/// A rim at height z over the camera is seen in the horizontal direction φ from the middle at the slope
/// z/ρ(φ); with the axis at D = r/sin η
///     ρ(φ) = D cos φ ∓ √(r² − D² sin²φ),
/// the nearer one for a base below the camera and a top above it, the farther one for a top below it. So a
/// pixel at slope t in the direction φ stands for the slope t·ρ(φ)/ρ(0) on the middle line, and all of them
/// together show one step along it. Its place, its blur and the levels before and behind are fitted.
///
/// Brightness. Below a base lie shadows, the post's and the crossbar's, of one hue with the ground: the
/// base is measured in the complement of the ground's colour, where they vanish; that the post is lit evenly
/// near its foot then counts. A top is measured in the complement of the post's colour, as its edges.
///
/// Nothing where what ends there need not be the post:
/// Step  of the blur that edges have, in the same place left and right of the middle, the post's colour
///       inside and another one outside;
/// Base  most of the picture below and beside it is of one hue, as the ground is: what stands before a foot
///       is of several, and ends;
/// Top   below it the post is as wide as it is, and on one side the picture goes on from below to above: on
///       the other may be the crossbar; and another projection of colours, where it finds a step, finds it
///       in the same place.
class PostEndFinder {
  public:
    /// All of them have to outlive it.
    PostEndFinder(YuyvView image, const Intrinsics& camera, const PostSilhouette& post,
                  const PostColour& colour, const PostEndSearch& search);
    /// `row`: the last, or first, in which the post's middle has its colour.
    std::optional<PostEnd> base(int row);
    std::optional<PostEnd> top(int row);

  private:
    struct Sample {
        double way;     // px, outwards along the middle line
        double value;   // 0: the post's colour; in sigmas of a pixel's noise
        double across;  // in radii, + right
        int row;
        PairColour offset;  // from the post's colour
    };
    struct Step {
        double place = 0.0, sigma = 0.0;  // px, of way
        double blur = 0.0;                // px
        double inner = 0.0, outer = 0.0;
        PairColour beyond = PairColour::Zero();
    };

    /// The end near a slope; `contrast` tells the post's colour from what lies beyond.
    std::optional<PostEnd> find(double slope, double outwards, const Eigen::Matrix3f& contrast);
    bool gather(double slope, double outwards, double per_px);
    std::optional<Step> fit_step(double start_blur, const Eigen::Matrix3f& contrast);
    std::optional<double> slope_at(int row) const;  // of the middle line
    /// The commonest colour below and beside a base.
    std::optional<PairColour> ground_about(const PostEnd& end) const;
    bool ends_free(const PostEnd& end) const;
    /// ρ(0)/ρ(φ) where `across` is sin φ / sin η.
    double rim(double across) const;
    std::optional<Eigen::Vector2d> pixel_at(double across, double slope) const;
    /// Mean of so many pairs, 1 or 2, in three rows.
    bool same_surface(const PairColour& a, const PairColour& b, float far) const;
    std::optional<PairColour> colour_at(double across, double slope, int pairs = 2) const;

    YuyvView image_;
    const Intrinsics& camera_;
    const PostSilhouette& post_;
    const PostColour& colour_;
    PostEndSearch search_;
    double sine_;          // of the half angle
    double near_ = 1.0;    // the rim's side that is seen: 1 the nearer, −1 the farther one
    double radius_ = 0.0;  // px, half the post's width at the end
    std::vector<Sample> samples_;
    RowColumn<double> ways_, values_;                     // theirs
    double gathered_at_ = 0.0, gathered_outwards_ = 0.0;  // slope and direction they are of; 0: of none
};

}  // namespace goalmouth
