#include "core/detection/cut_posts.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// The post's rows along one edge line.
struct RowsAlong {
    int count = 0;
    int reaching = 0;  // those that go on to the image's border
};

RowsAlong rows_along(const EdgeLine& edge, EdgeSide side, const Candidates& candidates, double near) {
    RowsAlong rows;
    for (const CandidateSegment& s : candidates.segments) {
        if (s.orientation != Orientation::horizontal) continue;
        if (s.line < edge.segment.upper.y() || s.line > edge.segment.lower.y()) continue;
        const auto x = edge.segment.line.x_at(s.line);
        const double end = side == EdgeSide::left ? s.start - 0.5 : s.end + 0.5;
        if (!x || std::abs(end - *x) >= near) continue;
        ++rows.count;
        rows.reaching += side == EdgeSide::left ? s.end == candidates.width - 1 : s.start == 0;
    }
    return rows;
}

}  // namespace

std::optional<Post> post_with_one_edge(const EdgeLine& edge, EdgeSide side, const Candidates& candidates,
                                       double near, const CutPostParameters& parameters) {
    if (!parameters.report) return std::nullopt;
    const RowsAlong rows = rows_along(edge, side, candidates, near);
    if (rows.reaching == 0 || rows.reaching < parameters.share * rows.count) return std::nullopt;
    const double border = side == EdgeSide::left ? candidates.width - 0.5 : -0.5;
    const double visible_width = std::abs(edge.segment.middle().x() - border);
    if (edge.segment.length() < parameters.least_aspect * visible_width) return std::nullopt;

    const Eigen::Vector2d border_top(border, edge.segment.upper.y());
    const Eigen::Vector2d border_base(border, edge.segment.lower.y());
    Post post;
    if (side == EdgeSide::left) {
        post.left_top = edge.segment.upper;
        post.left_base = edge.segment.lower;
        post.right_top = border_top;
        post.right_base = border_base;
        post.flags = post_flag::right_edge_missing | post_flag::cut_right;
        post.support_left = edge.support;
    } else {
        post.left_top = border_top;
        post.left_base = border_base;
        post.right_top = edge.segment.upper;
        post.right_base = edge.segment.lower;
        post.flags = post_flag::left_edge_missing | post_flag::cut_left;
        post.support_right = edge.support;
    }
    return post;
}

std::optional<Post> post_that_fills_image(const Candidates& candidates, const CutPostParameters& parameters) {
    if (!parameters.report || candidates.width <= 0) return std::nullopt;
    int first = candidates.height;
    int last = -1;
    int rows = 0;
    for (const CandidateSegment& s : candidates.segments) {
        if (s.orientation != Orientation::horizontal || s.start > 0 || s.end < candidates.width - 1) continue;
        first = std::min(first, s.line);
        last = std::max(last, s.line);
        ++rows;
    }
    if (rows < 2 || last - first < parameters.share * candidates.height) return std::nullopt;

    Post post;
    const double right = candidates.width - 0.5;
    post.left_top = {-0.5, first};
    post.left_base = {-0.5, last};
    post.right_top = {right, first};
    post.right_base = {right, last};
    post.flags = post_flag::fills_image | post_flag::left_edge_missing | post_flag::right_edge_missing |
                 post_flag::cut_left | post_flag::cut_right;
    return post;
}

}  // namespace goalmouth
