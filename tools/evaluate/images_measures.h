#pragma once

#include "core/evaluation/statistics.h"
#include "tools/evaluate/images_score.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// At which of its outline's visible length a detection's edges are compared, from the top.
inline constexpr std::array<double, 3> edge_heights{0.25, 0.5, 0.75};

/// How far a detection's edges lie from an outline's [px along the row, + right], at edge_heights; nothing
/// where the outline's edge ends at the picture's side, and so may go on beyond it, or the detection has
/// none.
struct EdgeErrors {
    std::array<std::optional<double>, 3> left, right, width;
};
EdgeErrors edge_errors(const ReferencePost& truth, const Post& detection, int picture_width);

/// An outlined post and the detection that means it (PostMatching::identified).
struct MeasuredPost {
    const ScoredPicture* picture = nullptr;
    std::size_t truth = 0;
    std::size_t detection = 0;
    EdgeErrors edges;
    std::optional<double> true_distance;  // m, where the robot's place is known
    std::optional<double> distance;       // m, as the chain says

    const Post& post() const { return picture->result.posts[detection]; }
    bool refined() const { return post().has(post_flag::refined); }
    std::optional<double> distance_error() const;  // m, estimated less true
    double largest_edge_error() const;             // px, of both edges; 0 where there is none
};
std::vector<MeasuredPost> measured_posts(const std::vector<const ScoredPicture*>& pictures);

/// Posts of one detector that belong together: all of a chain that refines none, else those it flags as
/// refined and those it does not.
struct MeasuredGroup {
    std::string name;  // "all", "refined", "not refined"
    std::vector<MeasuredPost> posts;
};
std::vector<MeasuredGroup> groups(const std::vector<MeasuredPost>& posts);

struct EdgeSummary {
    std::size_t posts = 0;
    std::optional<ErrorStatistics> left, right, width;  // px, over posts and heights
    std::optional<double> annotation_sigma;             // px, root mean square over those posts that state it
};
EdgeSummary edge_summary(const std::vector<MeasuredPost>& posts);

/// A post whose true distance is known [m].
struct DistanceSample {
    double truth = 0.0;
    std::optional<double> estimate;
};
std::vector<DistanceSample> distance_samples(const std::vector<MeasuredPost>& posts);
/// What the outlines themselves would say: the distance [m] at which a post of that diameter fills the wedge
/// between the planes through the camera and the middles of the outline's edges. Their direction is common
/// to both, square to the line of sight to the outline's middle: edges as a hand draws them are not parallel
/// enough for planes of their own, and that the post's middle is higher or lower than the camera, by an
/// angle e, makes it 1/cos e too long (1 % at 8°). Nothing where an edge ends at the picture's side. No
/// detector can be blamed for its error.
std::optional<double> outline_distance(const ReferencePost& outline, const Intrinsics& camera,
                                       double diameter);
std::vector<DistanceSample> outline_samples(const std::vector<const ScoredPicture*>& pictures,
                                            double diameter);

/// Posts by their true distance: from … below to [m].
struct DistanceSummary {
    double from = 0.0;
    double to = 0.0;
    std::size_t posts = 0;       // with an estimate
    std::size_t without = 0;     // an estimate
    ErrorStatistics errors;      // m
    double relative_rms = 0.0;   // of the error over the true distance
    double median_relative = 0;  // of its absolute value
};
/// Over all distances; nothing where there is no estimate.
std::optional<DistanceSummary> distance_summary(const std::vector<DistanceSample>& samples);
/// In steps of half a metre, those without an estimate left out.
std::vector<DistanceSummary> by_distance(const std::vector<DistanceSample>& samples);

/// How well the places fit the pictures, over all outlines of the set.
struct PlacementSummary {
    std::size_t posts = 0;     // outlines in pictures of known place
    std::size_t unplaced = 0;  // those of them that are none of the field's goalposts
    double direction_rms = 0;  // rad, of the others
};
PlacementSummary placement_summary(const std::vector<const ScoredPicture*>& pictures);

}  // namespace goalmouth
