#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/pixel_rays.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_silhouette.h"
#include "core/refinement/row_differences.h"

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Where a row leaves the post's colour.
struct EdgeCrossing {
    double u = 0.0, v = 0.0;  // normalised, undistorted
    double weight = 1.0;      // less, the farther from the rough edge
};

/// An edge as most of the crossings put it.
struct CoarseEdge {
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // through the camera's centre, towards the post; unit
    int agreeing = 0;
    int crossings = 0;
    double rival =
        0.0;  // of the next best parallel edge, how well crossings agree with it; as a share of this one's
};

/// What is to be found out before pixels can be fitted: where the edges are to about half a pixel.
struct CoarseSearch {
    double tolerance = 5.0;  // px, how far beside the rough outline
    float least_contrast = 3.0F;
    Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  // frame C
    double lean_sigma = 0.05;                        // rad, of `up`
};

/// Finds the edges about a rough outline.
///
/// In some rows it walks from inside outwards to where the post's colour ends (half-way to what comes then,
/// shading left out), wherever that is within the tolerance. Of each side's crossings the line with most of
/// them near it counts, so that up to about half may be of other things; at the tolerance's end a crossing
/// counts half. The two edges of a post share a direction: where they do not, the one with fewer crossings is
/// looked for again along the other.
class CoarseEdgeFinder {
  public:
    using Edges = std::array<std::optional<CoarseEdge>, 2>;  // left, right

    Edges find(YuyvView image, const RoughOutline& outline, const PostColour& colour,
               const Intrinsics& camera, const CoarseSearch& search);

  private:
    void collect(YuyvView image, const RoughOutline& outline, const PostColour& colour, PixelRays& rays,
                 const CoarseSearch& search, OutlineSide side);
    std::optional<CoarseEdge> line(OutlineSide side, double near) const;
    double rival_of(const CoarseEdge& edge, OutlineSide side, double near, const Eigen::Vector3d& axis) const;
    std::optional<CoarseEdge> line_along(OutlineSide side, double near, const Eigen::Vector3d& axis) const;

    std::array<std::vector<EdgeCrossing>, 2> crossings_;
    mutable std::vector<double> rivals_;
    RowDifferences differences_;
};

}  // namespace goalmouth
