#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/pixel_rays.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/post_silhouette.h"

namespace goalmouth {

/// The rows over which a post's edges can be seen.
struct PostExtent {
    int first_row = 0;  // px, the uppermost and lowermost row in which the post's middle has its colour
    int last_row = -1;
    bool top_seen = false;  // it ends there, and the picture goes on
    bool base_seen = false;
    int first_edge_row = 0;  // the rows between the ends of its side edges
    int last_edge_row = -1;
};

/// Follows a post from its rough rows to where its colour ends, up and down: longer than the rough outline
/// only while its middle has its colour and at least one side has another, shorter where its middle has not.
///
/// A cylinder's ends are bent: where the middle's line of sight meets an end at slope tan ε against the
/// square to the axis, the side edges end at (1 − sin η)·tan ε, as the front lies nearer by the radius.
/// Nothing where hardly any row has the post's colour.
PostExtent find_extent(YuyvView image, const PostSilhouette& post, const PostColour& colour,
                       const Intrinsics& camera, const RoughOutline& outline);

}  // namespace goalmouth
