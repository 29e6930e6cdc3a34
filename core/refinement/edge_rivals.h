#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/post_stand.h"
#include "core/refinement/run_ends.h"

#include <optional>
#include <vector>

namespace goalmouth {

/// What becomes of an edge of which some rows show the post's colour to end elsewhere.
///
/// Two things do that, and each row looks the same in both. Where something of the post's colour stands
/// behind it, the colour goes on beyond the edge; where something stands before it, the colour ends within.
/// So of two places where it ends either may be the edge, whatever has more rows. But what stands behind is
/// hardly as bright as the post along its edge: rows in which the colour goes on show a line or a step in
/// luma there (luma_line.h), and rows of a post that is hidden elsewhere show none. And a post is as high as
/// goals are: what goes on above the top of one so narrow, and ends at that of a wider one, is the wider one.
struct RivalVerdict {
    std::optional<RunEnds::Place> moved;  // where the edge is instead
    std::optional<RunEnd> at;             // if moved, in the middle one of the rows that show it
    std::vector<int> left_out;            // if moved, the picture's rows that say nothing of it
    int here = 0;                         // rows that end at the edge
    int undecided = 0;                    // rows that end at another place, which is or may be the edge's

    double rival() const { return undecided / (here > 0 ? static_cast<double>(here) : 1.0); }
};

/// `outwards` 1: of a right edge, −1: of a left one. `stand`: of the silhouette; what its colour does from
/// the crossbar up does not widen a post, and one that sinks has to be wider.
RivalVerdict judge_rivals(YuyvView image, const RunEnds& ends, int outwards, const PostStand& stand,
                          double blur);

}  // namespace goalmouth
