#pragma once

#include "core/detection/post.h"
#include "core/evaluation/post_matching.h"
#include "core/evaluation/reference_post.h"

#include <span>

#include <opencv2/core.hpp>

namespace goalmouth {

/// What the colours of draw_scored_posts mean (BGR).
namespace scored_colour {
inline const cv::Scalar found_truth(255, 255, 255);
inline const cv::Scalar missed_truth(255, 60, 255);
inline const cv::Scalar right_post(80, 255, 80);
inline const cv::Scalar wrong_post(70, 70, 255);
inline const cv::Scalar left_out(200, 200,
                                 200);  // known posts that do not count, detections that are ignored
}  // namespace scored_colour

/// Known posts and detections drawn into a picture (BGR, 8 bits), each in the colour of what became of it:
/// known posts white where found, violet where missed, grey where they do not count; detections green where
/// right, red where wrong, grey where ignored. Each of its four lines has the outline's side in its middle
/// and a dark seam; widths grow with the picture.
void draw_scored_posts(cv::Mat& picture, std::span<const ReferencePost> truth, std::span<const Post> posts,
                       const PostMatching& matching);

/// What the colours mean, in words.
inline constexpr const char* scored_legend =
    "White: a post that was found; violet: one that was missed; grey and dashed: one that does not count. "
    "Green: a detection that is right; red: one that is wrong; grey: ignored.";

}  // namespace goalmouth
