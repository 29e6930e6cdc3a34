#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/coarse_edges.h"
#include "core/refinement/post_colour.h"

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

    /// How much of the bow is there, about 0 or 1; 0 where nothing says so.
    double share() const;
    /// Its sigma as the rows scatter: textures, compression and things beside posts are no noise of pairs.
    double sigma() const;
    /// Logarithm of the odds that it is all there against none of it. That rows agree makes it no surer than
    /// how often something beside an edge looks like a bow all along it.
    double odds() const;

  private:
    double pull_ = 0.0, information_ = 0.0;
    double pull_square_ = 0.0, pull_information_ = 0.0, information_square_ = 0.0;  // sums over rows
};

/// Of each edge of a picture's posts.
class ResponseEvidence {
  public:
    ResponseEvidence() = default;
    /// Of one post.
    ResponseEvidence(const BowEvidence& left, const BowEvidence& right) : odds_(left.odds() + right.odds()) {}
    ResponseEvidence& operator+=(const ResponseEvidence& other) {
        odds_ += other.odds_;
        return *this;
    }

    /// Whether more edges can make it srgb.
    bool open(std::size_t edges) const;
    /// srgb where the bow is there beyond doubt: no one edge is enough, and edges that have none speak
    /// against those that do. What says nothing counts as linear.
    CameraResponse response() const;

  private:
    double odds_ = 0.0;
};

/// About the coarse edges of one post. `colour`: of levels, not of light.
ResponseEvidence response_evidence(YuyvView image, const RoughOutline& outline, const PostColour& colour,
                                   const Intrinsics& camera, const CoarseEdgeFinder::Edges& edges);

}  // namespace goalmouth
