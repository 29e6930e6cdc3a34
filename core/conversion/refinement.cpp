#include "core/conversion/refinement.h"

namespace goalmouth {
namespace {

void put(double (&to)[3], const Eigen::Vector3d& from) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}
void put(double (&to)[2], const Eigen::Vector2d& from) {
    for (int i = 0; i < 2; ++i) to[i] = from[i];
}

Eigen::Vector3d get(const double (&from)[3]) {
    return {from[0], from[1], from[2]};
}
Eigen::Vector2d get(const double (&from)[2]) {
    return {from[0], from[1]};
}

std::optional<RefinedEdge> edge(const double (&plane)[3], int rows) {
    if (get(plane).isZero(0.0)) return std::nullopt;
    return RefinedEdge{get(plane), rows};
}

}  // namespace

refined_post_t to_message(const RefinedPost& post) {
    refined_post_t m{};
    m.refined = post.post.has(post_flag::refined) ? 1 : 0;
    m.reason = post.reason;
    m.quality = post.quality;
    m.rows = post.rows;
    m.iterations = post.iterations;
    if (post.left) {
        m.rows_left = post.left->rows;
        put(m.left_plane, post.left->plane);
    }
    if (post.right) {
        m.rows_right = post.right->rows;
        put(m.right_plane, post.right->plane);
    }
    m.base_seen = post.base ? 1 : 0;
    if (post.base) put(m.base, *post.base);
    m.top_seen = post.top ? 1 : 0;
    if (post.top) put(m.top, *post.top);
    m.num_cues = static_cast<std::int32_t>(post.cues.size());
    for (const DistanceCue& cue : post.cues) {
        distance_cue_t c{};
        c.kind = static_cast<std::int8_t>(cue.kind);
        c.distance_m = cue.distance;
        c.sigma_m = cue.sigma;
        m.cues.push_back(c);
    }
    return m;
}

RefinedPost from_message(const refined_post_t& m) {
    RefinedPost post;
    if (m.refined != 0) post.post.flags |= post_flag::refined;
    post.reason = m.reason;
    post.quality = m.quality;
    post.rows = m.rows;
    post.iterations = m.iterations;
    post.left = edge(m.left_plane, m.rows_left);
    post.right = edge(m.right_plane, m.rows_right);
    if (m.base_seen != 0) post.base = get(m.base);
    if (m.top_seen != 0) post.top = get(m.top);
    for (const distance_cue_t& cue : m.cues)
        post.cues.push_back({static_cast<DistanceCueKind>(cue.kind), cue.distance_m, cue.sigma_m});
    return post;
}

refinement_t to_message(const std::vector<RefinedPost>& posts, std::int64_t utime, std::int64_t seq) {
    refinement_t m{};
    m.utime = utime;
    m.seq = seq;
    m.num_posts = static_cast<std::int32_t>(posts.size());
    for (const RefinedPost& post : posts) m.posts.push_back(to_message(post));
    return m;
}

std::vector<RefinedPost> from_message(const refinement_t& m) {
    std::vector<RefinedPost> posts;
    for (const refined_post_t& post : m.posts) posts.push_back(from_message(post));
    return posts;
}

std::vector<Post> posts_of(const std::vector<RefinedPost>& refined) {
    std::vector<Post> posts;
    for (const RefinedPost& post : refined) posts.push_back(post.post);
    return posts;
}

}  // namespace goalmouth
