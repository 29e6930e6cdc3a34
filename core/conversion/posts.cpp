#include "core/conversion/posts.h"

#include "core/conversion/intrinsics.h"

namespace goalmouth {
namespace {

void put(double (&to)[2], const Eigen::Vector2d& from) {
    to[0] = from.x();
    to[1] = from.y();
}

Eigen::Vector2d get(const double (&from)[2]) {
    return {from[0], from[1]};
}

}  // namespace

post_t to_message(const Post& post) {
    post_t m{};
    put(m.left_top, post.left_top);
    put(m.left_base, post.left_base);
    put(m.right_top, post.right_top);
    put(m.right_base, post.right_base);
    m.flags = static_cast<std::int32_t>(post.flags);
    m.side = static_cast<std::int8_t>(post.side);
    m.width_px = post.width_px;
    m.distance_m = post.distance_m;
    m.bearing_rad = post.bearing_rad;
    for (int i = 0; i < 4; ++i) m.covariance[i] = post.covariance(i / 2, i % 2);
    m.support_left = post.support_left;
    m.support_right = post.support_right;
    return m;
}

Post from_message(const post_t& m) {
    Post post;
    post.left_top = get(m.left_top);
    post.left_base = get(m.left_base);
    post.right_top = get(m.right_top);
    post.right_base = get(m.right_base);
    post.flags = static_cast<std::uint32_t>(m.flags);
    post.side = static_cast<PostSide>(m.side);
    post.width_px = m.width_px;
    post.distance_m = m.distance_m;
    post.bearing_rad = m.bearing_rad;
    for (int i = 0; i < 4; ++i) post.covariance(i / 2, i % 2) = m.covariance[i];
    post.support_left = m.support_left;
    post.support_right = m.support_right;
    return post;
}

posts_t to_message(const std::vector<Post>& posts, std::int64_t utime, std::int64_t seq,
                   const Intrinsics& camera, const std::string& detector) {
    posts_t m{};
    m.utime = utime;
    m.seq = seq;
    m.intrinsics = to_message(camera);
    m.detector = detector;
    m.num_posts = static_cast<std::int32_t>(posts.size());
    for (const Post& post : posts) m.posts.push_back(to_message(post));
    return m;
}

std::vector<Post> from_message(const posts_t& m) {
    std::vector<Post> posts;
    for (const post_t& post : m.posts) posts.push_back(from_message(post));
    return posts;
}

}  // namespace goalmouth
