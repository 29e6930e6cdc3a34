#include "core/detection/ransac_detector.h"

#include "core/detection/edge_lines.h"
#include "core/detection/post_order.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// σ of the line's place across itself, from how the points scatter about it [px].
double place_sigma(const EdgeLine& edge) {
    return edge.rms / std::sqrt(static_cast<double>(edge.support));
}

Post corners(const EdgeLine& left, const EdgeLine& right) {
    Post post;
    post.left_top = left.segment.upper;
    post.left_base = left.segment.lower;
    post.right_top = right.segment.upper;
    post.right_base = right.segment.lower;
    post.support_left = left.support;
    post.support_right = right.support;
    return post;
}

bool is_paired(const std::vector<EdgePair>& pairs, std::size_t EdgePair::*side, std::size_t i) {
    return std::any_of(pairs.begin(), pairs.end(), [&](const EdgePair& p) { return p.*side == i; });
}

}  // namespace

const std::vector<Post>& RansacDetector::detect(const Candidates& candidates, const Intrinsics& camera,
                                                Random& random) {
    const auto& left = left_.find(candidates.left_edges, random);
    const auto& right = right_.find(candidates.right_edges, random);
    const auto& pairs = pairing_.pair(left, right, candidates, camera.fx * diameter_);

    posts_.clear();
    const auto add = [&](Post post, double left_sigma, double right_sigma) {
        measure_post(post, camera, diameter_, left_sigma, right_sigma, parameters_.measurement);
        insert_from_left(posts_, post);
    };
    for (const auto& [i, j] : pairs)
        add(corners(left[i], right[j]), place_sigma(left[i]), place_sigma(right[j]));
    const auto add_cut = [&](const std::vector<EdgeLine>& lines, std::size_t EdgePair::*side, EdgeSide edge) {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (is_paired(pairs, side, i)) continue;
            const auto post = post_with_one_edge(lines[i], edge, candidates,
                                                 parameters_.ransac.inlier_distance, parameters_.cut_posts);
            if (post) add(*post, 0.0, 0.0);
        }
    };
    add_cut(left, &EdgePair::left, EdgeSide::left);
    add_cut(right, &EdgePair::right, EdgeSide::right);
    if (posts_.empty()) {
        if (const auto post = post_that_fills_image(candidates, parameters_.cut_posts)) add(*post, 0.0, 0.0);
    }
    assign_sides(posts_, candidates, parameters_.sides);
    return posts_;
}

std::vector<Post> detect_posts_by_ransac(const Candidates& candidates, const Intrinsics& camera,
                                         double diameter, const RansacDetectorParameters& parameters,
                                         Random& random) {
    return RansacDetector(parameters, diameter).detect(candidates, camera, random);
}

}  // namespace goalmouth
