#pragma once

#include "core/refinement/refined_post.h"

#include <cstdint>
#include <vector>

#include <goalmouth/refined_post_t.hpp>
#include <goalmouth/refinement_t.hpp>

namespace goalmouth {

/// How a post was measured; the post itself travels in POSTS_REFINED.
refined_post_t to_message(const RefinedPost& post);
/// `post` of the result is not in the message: it stays as a Post is made.
RefinedPost from_message(const refined_post_t& message);

refinement_t to_message(const std::vector<RefinedPost>& posts, std::int64_t utime, std::int64_t seq);
std::vector<RefinedPost> from_message(const refinement_t& message);

/// The posts alone, as POSTS_REFINED carries them.
std::vector<Post> posts_of(const std::vector<RefinedPost>& refined);

}  // namespace goalmouth
