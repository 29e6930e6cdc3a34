#pragma once

#include "core/detection/post.h"
#include "core/extraction/candidates.h"
#include "core/parameters/parameters.h"

#include <vector>

namespace goalmouth {

struct PostSideParameters {
    double crossbar_length = 1.0;
    double largest_width_ratio = 1.6;
};

template <class Visitor>
void describe_parameters(Visitor& v, PostSideParameters& p) {
    v("crossbar_length", p.crossbar_length, above(0), "1",
      "a segment that leaves a post sideways near its top by this many post widths is its crossbar");
    v("largest_width_ratio", p.largest_width_ratio, at_least(1), "1",
      "two posts whose widths differ by no more than this are of one goal");
}

/// Says which post of its goal each is, seen from the field, where that shows:
///   * a crossbar that leaves the post at its top on one side alone: where it leaves to the right, this is
///     the left post, and the other way round;
///   * else exactly two posts with both edges seen, alike in width: the left one is the left post.
/// Otherwise, and where the two contradict each other, unknown.
void assign_sides(std::vector<Post>& posts, const Candidates& candidates,
                  const PostSideParameters& parameters);

}  // namespace goalmouth
