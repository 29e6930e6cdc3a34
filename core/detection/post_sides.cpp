#include "core/detection/post_sides.h"

#include <algorithm>
#include <cstddef>

namespace goalmouth {
namespace {

/// Lies a crossbar to the left or right of the post's top?
PostSide side_by_crossbar(const Post& post, const Candidates& candidates,
                          const PostSideParameters& parameters) {
    const double top = std::min(post.left_top.y(), post.right_top.y());
    const double reach = 1.5 * post.width_px;
    const double length = parameters.crossbar_length * post.width_px;
    bool to_left = false;
    bool to_right = false;
    for (const CandidateSegment& s : candidates.segments) {
        if (s.orientation != Orientation::horizontal || s.line < top - reach || s.line > top + reach)
            continue;
        if (s.end < post.left_top.x() || s.start > post.right_top.x()) continue;
        to_left |= s.start < post.left_top.x() - length;
        to_right |= s.end > post.right_top.x() + length;
    }
    if (to_left == to_right) return PostSide::unknown;
    return to_right ? PostSide::left : PostSide::right;
}

bool opposite(PostSide found, PostSide claimed) {
    return found != PostSide::unknown && found != claimed;
}

}  // namespace

void assign_sides(std::vector<Post>& posts, const Candidates& candidates,
                  const PostSideParameters& parameters) {
    for (Post& post : posts) {
        post.side = post.has(post_flag::fills_image) ? PostSide::unknown
                                                     : side_by_crossbar(post, candidates, parameters);
    }
    const auto is_whole = [](const Post& post) {
        return !post.has(post_flag::left_edge_missing | post_flag::right_edge_missing);
    };
    if (posts.size() != 2 || !is_whole(posts[0]) || !is_whole(posts[1])) return;
    const bool swapped = posts[0].left_base.x() > posts[1].left_base.x();
    Post& left = posts[swapped ? 1 : 0];
    Post& right = posts[swapped ? 0 : 1];
    const auto [narrow, wide] = std::minmax(left.width_px, right.width_px);
    if (wide > parameters.largest_width_ratio * narrow) return;
    if (opposite(left.side, PostSide::left) || opposite(right.side, PostSide::right)) {
        left.side = right.side = PostSide::unknown;
        return;
    }
    left.side = PostSide::left;
    right.side = PostSide::right;
}

}  // namespace goalmouth
