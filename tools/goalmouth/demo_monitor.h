#pragma once

#include "core/geometry/pose2.h"
#include "core/imaging/yuyv.h"
#include "core/messaging/bus.h"
#include "core/messaging/image_input.h"
#include "core/process/graph.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <goalmouth/border_t.hpp>
#include <goalmouth/candidates_t.hpp>
#include <goalmouth/particles_t.hpp>
#include <goalmouth/pose_t.hpp>
#include <goalmouth/posts_t.hpp>
#include <goalmouth/truth_t.hpp>

namespace goalmouth {

/// How far an estimate was from the truth in one frame.
struct PoseError {
    std::int64_t utime = 0;
    double metres = 0.0;
    double radians = 0.0;
};

/// One frame with all that the graph said about it: what the demonstration shows as a picture.
struct SeenFrame {
    YuyvImage image;
    std::optional<border_t> border;
    std::optional<candidates_t> candidates;
    posts_t posts;
};

/// Listens to a running graph and remembers what a person wants to know of it afterwards.
class DemoMonitor {
  public:
    /// Subscribes to the channels on which the graph publishes what is watched; a graph need not have them
    /// all.
    DemoMonitor(Bus& bus, const Graph& graph);

    std::int64_t frames() const { return frames_; }
    std::int64_t posts() const { return posts_; }
    /// Frames with an answer of the detector, per second between the first and the last.
    double frames_per_second() const;
    double posts_per_frame() const;

    /// Every estimate with its truth, in order; empty where the graph publishes no truth.
    const std::vector<PoseError>& errors() const { return errors_; }
    /// Medians over the last `seconds` of data.
    std::optional<PoseError> median_error(double seconds) const;

    const std::optional<pose_t>& pose() const { return pose_; }
    const std::optional<particles_t>& particles() const { return particles_; }
    const std::vector<Pose2>& estimated_path() const { return estimated_; }
    const std::vector<Pose2>& true_path() const { return true_; }

    /// The frame that shows the most, if any was seen with its pixels.
    const std::optional<SeenFrame>& best_frame() const { return best_; }

  private:
    void see_frame(const Frame& frame);
    void see_posts(const posts_t& posts);
    void see_pose(const pose_t& pose);
    void match_pose_with_truth();

    std::int64_t frames_ = 0;
    std::int64_t posts_ = 0;
    std::int64_t first_frame_ = 0;  // µs, clock at arrival
    std::int64_t last_frame_ = 0;
    std::vector<PoseError> errors_;
    std::optional<pose_t> pose_;
    std::optional<particles_t> particles_;
    std::vector<Pose2> estimated_;
    std::vector<Pose2> true_;

    std::map<std::int64_t, truth_t> truths_;  // by utime, the last few
    std::deque<pose_t> unmatched_;
    std::map<std::int64_t, YuyvImage> images_;  // by utime, the last few
    std::map<std::int64_t, border_t> borders_;
    std::map<std::int64_t, candidates_t> candidates_;
    std::optional<SeenFrame> best_;
    int best_score_ = 0;
    std::unique_ptr<ImageInput> image_input_;
};

}  // namespace goalmouth
