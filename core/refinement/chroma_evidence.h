#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/coarse_edges.h"
#include "core/refinement/post_colour.h"

#include <array>
#include <cstddef>
#include <optional>

namespace goalmouth {

/// How far right of its luma one side's edges show a camera's chroma: the lag at which the one's steps go
/// with the other's.
class ChromaLag {
  public:
    static constexpr int most = 8;    // px
    static constexpr int blocks = 8;  // of neighbouring rows, which share a background
    using Steps = std::array<double, 2 * most + 1>;

    /// Of rows of one block, Σ chroma's step · luma's step `lag` px before it, by lag from −most on.
    Steps& block(int i) { return steps_[static_cast<std::size_t>(i)]; }
    ChromaLag& operator+=(const ChromaLag& other);

    struct Told {
        double lag = 0.0;    // px
        double sigma = 0.0;  // px, as blocks of rows scatter
    };
    std::optional<Told> told() const;

  private:
    std::array<Steps, blocks> steps_{};
};

/// Of the left and the right edges of a picture's posts. A post's shading, or something behind an edge, moves
/// luma's steps, too, but on the other side the other way or not at all.
class ChromaEvidence {
  public:
    ChromaLag& side(std::size_t i) { return sides_[i]; }
    ChromaEvidence& operator+=(const ChromaEvidence& other);

    /// By how much the chroma lies right of the luma [px]; 0 where that is not beyond doubt, or the sides
    /// say different things.
    double shift() const;

  private:
    std::array<ChromaLag, 2> sides_;
};

/// About the coarse edges of one post. `colour`: of levels, not of light.
ChromaEvidence chroma_evidence(YuyvView image, const RoughOutline& outline, const PostColour& colour,
                               const Intrinsics& camera, const CoarseEdgeFinder::Edges& edges);

}  // namespace goalmouth
