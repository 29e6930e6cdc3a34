#pragma once

#include "core/detection/post.h"
#include "core/extraction/border.h"
#include "core/extraction/candidates.h"
#include "core/segmentation/segments.h"

#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth {

// What was found, drawn into the picture it was found in (BGR, 8 bits). Line widths and letters grow with the
// picture.

/// Over all that was in the picture: the segments of its rows in their classes' colours, as wide as the rows
/// are apart but for a dark line between them.
void draw_segments(cv::Mat& picture, const Segments& segments);

/// The field's border, with its points.
void draw_border(cv::Mat& picture, const FieldBorder& border);

/// Candidate segments as faint lines, left and right edge points as dots in two colours.
void draw_candidates(cv::Mat& picture, const Candidates& candidates);

/// Each post's outline, an edge that was not seen dashed, with distance and side beside it; thin and white
/// where it is refined.
void draw_posts(cv::Mat& picture, const std::vector<Post>& posts);

}  // namespace goalmouth
