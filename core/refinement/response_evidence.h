#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/coarse_edges.h"
#include "core/refinement/post_colour.h"

#include <array>
#include <cstddef>

namespace goalmouth {

/// What the pixels between post and background say of a camera's response.
///
/// Where levels are in proportion to light they lie, in (Y, Cb, Cr), on the straight line from the post's
/// colour to the background's; where light is coded as screens expect it, on a bow, by as much as
///     level(½ light(post) + ½ light(background)) − ½ (post + background)
/// in the middle, and 4·E·(1 − E) of that where the share E is the background's. Across the line, and with
/// the post's shading left out, that is neither an edge's place nor its blur; luma that is sharper than
/// chroma bows outwards on one side of an edge and inwards on the other, and cancels.
class BowEvidence {
  public:
    /// One row: Σ measured · expected and Σ expected² of its pairs, in sigmas of a pair's noise.
    void add(double pull, double information);
    BowEvidence& operator+=(const BowEvidence& other);

    /// How much of the bow is there, about 0 or 1; 0 where nothing says so.
    double share() const;
    /// Its sigma as the rows scatter: textures, compression and things beside posts are no noise of pairs.
    double sigma() const;
    /// Whether it is all there, to so many sigmas.
    bool there(double sigmas) const;

  private:
    double pull_ = 0.0, information_ = 0.0;
    double pull_square_ = 0.0, pull_information_ = 0.0, information_square_ = 0.0;  // sums over rows
};

/// Of the left and the right edges of a picture's posts: what only happens to stand beside one looks like a
/// bow on its side alone.
class ResponseEvidence {
  public:
    BowEvidence& side(std::size_t i) { return sides_[i]; }
    ResponseEvidence& operator+=(const ResponseEvidence& other);

    /// srgb where the bow is there beyond doubt on both sides. What says nothing counts as linear.
    CameraResponse response() const;

  private:
    std::array<BowEvidence, 2> sides_;
};

/// About the coarse edges of one post. `colour`: of levels, not of light.
ResponseEvidence response_evidence(YuyvView image, const RoughOutline& outline, const PostColour& colour,
                                   const Intrinsics& camera, const CoarseEdgeFinder::Edges& edges);

}  // namespace goalmouth
