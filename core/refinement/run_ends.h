#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_extent.h"
#include "core/refinement/post_silhouette.h"

#include <array>
#include <limits>
#include <vector>

namespace goalmouth {

/// Where the post's colour ends on the way out, in one row.
struct RunEnd {
    int y = 0;
    double edge = 0.0;    // px, the silhouette's edge
    double width = 0.0;   // px, to its other edge
    double beyond = 0.0;  // px, the end, outwards of the edge
};

/// Rows of one edge: where the post's colour ends on the way from the post's inside out.
struct RunEnds {
    /// A place beside the edge where many end.
    struct Place {
        double beyond = 0.0;  // px outwards
        int rows = 0;
    };

    std::vector<RunEnd> rows;  // from the uppermost down
    int step = 1;              // each stands for so many rows of the picture, from its own down
    double tolerance = 0.0;    // px: what ends nearer to the edge ends there
    double spread = 0.0;       // px: what ends at one place lies so near to it
    /// px: what ends farther out does so far outside.
    double near_by = std::numeric_limits<double>::infinity();

    bool ends_here(const RunEnd& row) const;
    int here() const;
    /// Where most of those end that do so farther in than the edge, or farther out.
    Place inside() const;
    Place outside() const;
    /// The same farther out than near_by, the post's width and a few px.
    Place far_outside() const;
};

/// Of a silhouette's left and right edge. What decides for an edge elsewhere is the fit's business; this
/// looks at the picture alone, so that a straight edge of what stands before a post or behind it shows:
/// within it the post's colour ends sooner, or goes on beyond, by no more than four of the post's widths and
/// a few px. The rows are those in which the edges can be seen and, as what a silhouette too wide takes in
/// may end above the post's foot, those below while they show its colour. `blur` [px]: of the edges, along
/// the row.
std::array<RunEnds, 2> run_ends(YuyvView image, const PostSilhouette& post, const PostColour& colour,
                                const Intrinsics& camera, const PostExtent& extent, double blur);

}  // namespace goalmouth
