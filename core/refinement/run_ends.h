#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_extent.h"
#include "core/refinement/post_silhouette.h"

#include <array>

namespace goalmouth {

/// Where the post's colour ends on the way from its middle out, over the rows of one edge.
struct RunEnds {
    int here = 0;       // rows in which it ends at the edge
    int elsewhere = 0;  // the most that end at one other distance from it, within the post's width

    /// 0 where all end at the edge; 1 where as many end at another place.
    double rival() const { return elsewhere / (here > 0 ? static_cast<double>(here) : 1.0); }
};

/// Of a silhouette's left and right edge. What decides for an edge elsewhere is the fit's business; this
/// looks at the picture alone, so that a straight edge of what stands before a post or behind it shows:
/// within it the post's colour ends sooner, or goes on beyond. `blur` [px]: of the edges, along the row.
std::array<RunEnds, 2> run_ends(YuyvView image, const PostSilhouette& post, const PostColour& colour,
                                const Intrinsics& camera, const PostExtent& extent, double blur);

}  // namespace goalmouth
