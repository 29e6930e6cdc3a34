#include "core/detection/ransac_detector.h"

#include "core/detection/edge_lines.h"

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

std::vector<EdgeLine> without(const std::vector<EdgeLine>& lines, const std::vector<EdgePair>& pairs,
                              std::size_t EdgePair::*side) {
    std::vector<EdgeLine> rest;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (std::none_of(pairs.begin(), pairs.end(), [&](const EdgePair& p) { return p.*side == i; }))
            rest.push_back(lines[i]);
    }
    return rest;
}

}  // namespace

std::vector<Post> detect_posts_by_ransac(const Candidates& candidates, const Intrinsics& camera,
                                         double diameter, const RansacDetectorParameters& parameters,
                                         Random& random) {
    const auto left = find_lines(candidates.left_edges, parameters.ransac, random);
    const auto right = find_lines(candidates.right_edges, parameters.ransac, random);
    const auto pairs = pair_edges(left, right, candidates, camera.fx * diameter, parameters.pairing);

    std::vector<Post> posts;
    for (const auto& [i, j] : pairs) {
        Post post = corners(left[i], right[j]);
        measure_post(post, camera, diameter, place_sigma(left[i]), place_sigma(right[j]),
                     parameters.measurement);
        posts.push_back(post);
    }
    std::vector<Post> cut =
        posts_with_one_edge(without(left, pairs, &EdgePair::left), without(right, pairs, &EdgePair::right),
                            candidates, parameters.ransac.inlier_distance, parameters.cut_posts);
    if (posts.empty() && cut.empty()) cut = post_that_fills_image(candidates, parameters.cut_posts);
    for (Post& post : cut) {
        measure_post(post, camera, diameter, 0.0, 0.0, parameters.measurement);
        posts.push_back(post);
    }

    std::stable_sort(posts.begin(), posts.end(),
                     [](const Post& a, const Post& b) { return a.left_base.x() < b.left_base.x(); });
    assign_sides(posts, candidates, parameters.sides);
    return posts;
}

}  // namespace goalmouth
