#pragma once

#include "core/detection/post.h"
#include "core/evaluation/reference_post.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

/// When a detected post is a true one. At two heights, a quarter and three quarters down the true post's
/// visible length, both side edges must lie within max(fraction · true width, floor) of the true edges,
/// measured along the row; the true width is that between its edges along the same row. A detected edge is
/// the straight line through its ends. The detection's own length must cover at least `coverage` of the
/// visible length's rows. One detection for one post, the best agreeing pairs first.
struct MatchingRule {
    double fraction = 0.25;  // of the true width
    double floor = 0.0;      // px; 3 for outlines marked by hand, which are no better than that
    double coverage = 0.5;   // of the rows of the visible length
};

enum class Verdict {
    found,    // of a post that counts, by the rule
    ignored,  // by the rule or by identification of a post that does not count, or centred in a box to ignore
    wrong     // all else
};

struct PostMatching {
    /// By true post: the detection that found it by the rule.
    std::vector<std::optional<std::size_t>> found;
    /// By true post: the detection that means it, however badly its edges lie: the one that found it, else
    /// one where the middle of either (the mean of its corners) lies inside the outline of the other;
    /// one-to-one, the nearest middles first. Distance errors are taken over these, because the rule itself
    /// cuts errors of width off.
    std::vector<std::optional<std::size_t>> identified;
    std::vector<Verdict> verdicts;  // by detection

    std::size_t found_count(std::span<const ReferencePost> truth) const;  // of those that count
    std::size_t wrong_count() const;
};

PostMatching match_posts(std::span<const ReferencePost> truth, std::span<const Post> detections,
                         const MatchingRule& rule = {}, std::span<const Eigen::AlignedBox2d> ignore = {});

/// How far the detected edges lie from the true ones [px along the row, + right]: left and right edge, mean
/// over the two heights of the rule. Infinite where an edge is level.
std::array<double, 2> edge_offsets(const ReferencePost& truth, const Post& detection);

}  // namespace goalmouth
