#include "tools/goalmouth/demo_monitor.h"

#include "core/messaging/channels.h"
#include "core/messaging/clock.h"
#include "core/messaging/typed.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// What is kept while its counterparts may still be on their way.
constexpr std::size_t remembered_frames = 30;

template <class T>
void remember(std::map<std::int64_t, T>& kept, std::int64_t utime, T value) {
    kept.insert_or_assign(utime, std::move(value));
    while (kept.size() > remembered_frames) kept.erase(kept.begin());
}

template <class T>
std::optional<T> recall(const std::map<std::int64_t, T>& kept, std::int64_t utime) {
    const auto found = kept.find(utime);
    return found == kept.end() ? std::nullopt : std::optional<T>(found->second);
}

/// The channel on which some process of the graph publishes what it calls `channel` by default.
std::optional<std::string> published_channel(const Graph& graph, const std::string& channel) {
    for (const auto& process : graph.processes) {
        for (const auto& use : process.description.info.publishes) {
            if (use.channel == channel) return process.channel(channel);
        }
    }
    return std::nullopt;
}

/// A picture with the two posts of a goal and nothing else says most, and more so the better they are
/// supported.
int score(const posts_t& posts) {
    int total = 0;
    int sides = 0;
    for (const auto& post : posts.posts) {
        if (post.flags & post_t::NO_DISTANCE) continue;
        if (post.side != post_t::SIDE_UNKNOWN) ++sides;
        total += std::min(post.support_left, 60) + std::min(post.support_right, 60);
    }
    if (sides == 2 && posts.num_posts == 2) total += 2000;
    return total;
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

DemoMonitor::DemoMonitor(Bus& bus, const Graph& graph) {
    auto posts = published_channel(graph, channels::posts_refined);
    if (!posts) posts = published_channel(graph, channels::posts);
    if (posts) {
        subscribe<posts_t>(bus, *posts, [this](const posts_t& m) { see_posts(m); });
    }
    if (const auto channel = published_channel(graph, channels::border)) {
        subscribe<border_t>(bus, *channel, [this](const border_t& m) { remember(borders_, m.utime, m); });
    }
    if (const auto channel = published_channel(graph, channels::candidates)) {
        subscribe<candidates_t>(bus, *channel,
                                [this](const candidates_t& m) { remember(candidates_, m.utime, m); });
    }
    if (const auto channel = published_channel(graph, channels::pose)) {
        subscribe<pose_t>(bus, *channel, [this](const pose_t& m) { see_pose(m); });
    }
    if (const auto channel = published_channel(graph, channels::particles)) {
        subscribe<particles_t>(bus, *channel, [this](const particles_t& m) { particles_ = m; });
    }
    if (const auto channel = published_channel(graph, channels::truth)) {
        subscribe<truth_t>(bus, *channel, [this](const truth_t& m) {
            remember(truths_, m.utime, m);
            true_.push_back({m.x, m.y, m.theta});
            match_pose_with_truth();
        });
    }
    if (const auto channel = published_channel(graph, channels::image)) {
        image_input_ = std::make_unique<ImageInput>(bus, *channel, "", "",
                                                    [this](const Frame& frame) { see_frame(frame); });
    }
}

double DemoMonitor::frames_per_second() const {
    if (frames_ < 2 || last_frame_ <= first_frame_) return 0.0;
    return 1e6 * static_cast<double>(frames_ - 1) / static_cast<double>(last_frame_ - first_frame_);
}

double DemoMonitor::posts_per_frame() const {
    return frames_ == 0 ? 0.0 : static_cast<double>(posts_) / static_cast<double>(frames_);
}

std::optional<PoseError> DemoMonitor::median_error(double seconds) const {
    if (errors_.empty()) return std::nullopt;
    const std::int64_t since = errors_.back().utime - static_cast<std::int64_t>(1e6 * seconds);
    std::vector<double> metres;
    std::vector<double> radians;
    for (const auto& error : errors_) {
        if (error.utime < since) continue;
        metres.push_back(error.metres);
        radians.push_back(error.radians);
    }
    return PoseError{errors_.back().utime, median_of(metres), median_of(radians)};
}

void DemoMonitor::see_frame(const Frame& frame) {
    YuyvImage copy(frame.pixels.width, frame.pixels.height);
    for (int y = 0; y < frame.pixels.height; ++y) {
        std::copy_n(frame.pixels.row(y), copy.stride(),
                    copy.data.begin() + static_cast<std::ptrdiff_t>(y) * copy.stride());
    }
    if (frame.still_valid()) remember(images_, frame.utime, std::move(copy));
}

void DemoMonitor::see_posts(const posts_t& posts) {
    const std::int64_t now = now_utime();
    if (frames_++ == 0) first_frame_ = now;
    last_frame_ = now;
    posts_ += posts.num_posts;
    if (best_ && score(posts) <= best_score_) return;
    const auto image = recall(images_, posts.utime);
    if (!image) return;
    best_ = SeenFrame{*image, recall(borders_, posts.utime), recall(candidates_, posts.utime), posts};
    best_score_ = score(posts);
}

void DemoMonitor::see_pose(const pose_t& pose) {
    pose_ = pose;
    estimated_.push_back({pose.x, pose.y, pose.theta});
    unmatched_.push_back(pose);
    if (unmatched_.size() > remembered_frames) unmatched_.pop_front();
    match_pose_with_truth();
}

void DemoMonitor::match_pose_with_truth() {
    while (!unmatched_.empty()) {
        const pose_t& pose = unmatched_.front();
        const auto truth = truths_.find(pose.utime);
        if (truth == truths_.end()) {
            // A truth that is not there although later ones are was lost on the way.
            if (truths_.empty() || truths_.rbegin()->first < pose.utime) return;
        } else {
            const truth_t& t = truth->second;
            errors_.push_back({pose.utime, std::hypot(pose.x - t.x, pose.y - t.y),
                               std::abs(wrap_angle(pose.theta - t.theta))});
        }
        unmatched_.pop_front();
    }
}

}  // namespace goalmouth
