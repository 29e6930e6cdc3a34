#pragma once

#include "core/detection/post.h"
#include "core/evaluation/post_matching.h"
#include "core/evaluation/reference_post.h"

#include <span>

#include <opencv2/core.hpp>

namespace goalmouth {

/// Known posts and detections drawn into a picture (BGR, 8 bits), each in the colour of what became of it:
/// known posts white where found, violet where missed, grey where they do not count; detections green where
/// right, red where wrong, grey where ignored.
void draw_scored_posts(cv::Mat& picture, std::span<const ReferencePost> truth, std::span<const Post> posts,
                       const PostMatching& matching);

/// What the colours mean, in words.
inline constexpr const char* scored_legend =
    "White: a post that was found; violet: one that was missed; grey and dashed: one that does not count. "
    "Green: a detection that is right; red: one that is wrong; grey: ignored.";

}  // namespace goalmouth
