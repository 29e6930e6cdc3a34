#pragma once

#include "core/detection/edge_lines.h"
#include "core/detection/post.h"
#include "core/extraction/candidates.h"
#include "core/parameters/parameters.h"

#include <optional>

namespace goalmouth {

struct CutPostParameters {
    bool report = true;
    double share = 0.5;
    double least_aspect = 1.5;
};

template <class Visitor>
void describe_parameters(Visitor& v, CutPostParameters& p) {
    v("report", p.report,
      "report posts that the image's left or right border cuts (ours; the paper knows whole posts only)");
    v("share", p.share, Range{0, 1}, "1",
      "share of the rows along the one visible edge, or of the image's rows, in which the post reaches the "
      "border");
    v("least_aspect", p.least_aspect, Range{0, 1000}, "1",
      "least length of a post with one visible edge over its visible width");
}

enum class EdgeSide { left, right };

/// A post of which one side edge lies outside the image: an edge line without a partner, beside which the
/// post's colour goes on to the image's border in at least `share` of the rows. The missing edge is put on
/// the border, flags say so; corners, supports and flags are set, measurements are not. `side`: which edge of
/// a post the line is. `near` [px]: how far a segment's end may lie from the line it belongs to.
std::optional<Post> post_with_one_edge(const EdgeLine& edge, EdgeSide side, const Candidates& candidates,
                                       double near, const CutPostParameters& parameters);

/// A post so close that neither side edge is in the image: segments from border to border over at least
/// `share` of the image's height. Its corners are the image's.
std::optional<Post> post_that_fills_image(const Candidates& candidates, const CutPostParameters& parameters);

}  // namespace goalmouth
