#pragma once

#include "core/segmentation/segments.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// A segment of the post's colour that may belong to a post.
struct CandidateSegment {
    Orientation orientation = Orientation::horizontal;
    int line = 0;   // px: y of a horizontal, x of a vertical segment
    int start = 0;  // px along the line, first pixel
    int end = 0;    // px along the line, last pixel

    int length() const { return end - start + 1; }
    Eigen::Vector2d centre() const {
        const double along = 0.5 * (start + end);
        return orientation == Orientation::horizontal ? Eigen::Vector2d(along, line)
                                                      : Eigen::Vector2d(line, along);
    }
};

/// Where a row shows the field: no post is there.
struct FieldRun {
    int line = 0;   // px: y of the horizontal scan-line
    int start = 0;  // px along the line, first pixel
    int end = 0;    // px along the line, last pixel

    int length() const { return end - start + 1; }
};

/// What may belong to goalposts in one frame (paper, section 2, step 4). The histogram works on `segments`,
/// RANSAC on the two edge-point sets: the text's "segment centres" cannot give edges.
struct Candidates {
    int width = 0;   // px of the image
    int height = 0;  // px of the image
    std::vector<CandidateSegment> segments;
    std::vector<FieldRun> field;
    std::vector<Eigen::Vector2d> left_edges;   // px: background → post transitions
    std::vector<Eigen::Vector2d> right_edges;  // px: post → background transitions
};

}  // namespace goalmouth
