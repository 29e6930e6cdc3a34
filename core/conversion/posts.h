#pragma once

#include "core/detection/post.h"
#include "core/geometry/camera.h"

#include <cstdint>
#include <string>
#include <vector>

#include <goalmouth/post_t.hpp>
#include <goalmouth/posts_t.hpp>

namespace goalmouth {

post_t to_message(const Post& post);
Post from_message(const post_t& message);

posts_t to_message(const std::vector<Post>& posts, std::int64_t utime, std::int64_t seq,
                   const Intrinsics& camera, const std::string& detector);
std::vector<Post> from_message(const posts_t& message);

}  // namespace goalmouth
