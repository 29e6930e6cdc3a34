#pragma once

#include "core/detection/post.h"

#include <algorithm>
#include <vector>

namespace goalmouth {

/// Adds a post to posts that are in order from left to right; of posts at one place the first stays first.
inline void insert_from_left(std::vector<Post>& posts, const Post& post) {
    const auto behind = std::upper_bound(posts.begin(), posts.end(), post.left_base.x(),
                                         [](double x, const Post& other) { return x < other.left_base.x(); });
    posts.insert(behind, post);
}

}  // namespace goalmouth
