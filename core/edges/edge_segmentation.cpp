#include "core/edges/edge_segmentation.h"

#include "core/edges/frame_scale.h"
#include "core/edges/post_rules.h"
#include "core/edges/strip_growth.h"
#include "core/imaging/vertical_blur.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace goalmouth {
namespace {

/// The survey looks at about so many scan-lines, evenly spread, and there at so many pairs.
constexpr std::size_t survey_rows = 16;
constexpr int survey_pairs = 48;

/// Memory is asked for so many rows of the layout before their turn.
constexpr std::size_t rows_ahead = 2;

/// A chain begins with a surface at least this share as bright as a post has to be: one part of it may lie in
/// shade.
constexpr double share_of_brightness = 0.7;
/// and a stretch that both its edges show this share.
constexpr double share_of_mean_brightness = 0.9;

/// No more strips are grown, the most distinct first: a frame with as many (a chequerboard, a fence) has
/// those of its posts among them. Real pictures have some twenty.
constexpr std::size_t most_strips = 128;

/// Posts do not touch: what shares an edge with another strip is what lies behind that one.
bool touch(const UprightStrip& a, const UprightStrip& b) {
    const double top = std::max(a.top(), b.top());
    const double base = std::min(a.base(), b.base());
    if (base < top) return false;
    const double y = 0.5 * (top + base);
    const double apart = std::max(a.left.at(y), b.left.at(y)) - std::min(a.right.at(y), b.right.at(y));
    return apart < 0.5 * std::min(a.width_at(y), b.width_at(y));
}

/// Whether growing a seed would only make a strip anew: its middle lies in one that is a post, or its edges
/// lie on those of any.
bool known(const StripSeed& seed, const FrameEdges& frame, const JudgedStrip& judged, double straightness) {
    const UprightStrip& strip = judged.strip;
    const double y = 0.5 * (frame.y(seed.first_row) + frame.y(seed.last_row));
    if (y < strip.top() || y > strip.base()) return false;
    const double left = seed.left.at(y) - strip.left.at(y);
    const double right = seed.right.at(y) - strip.right.at(y);
    if (std::abs(left) <= straightness && std::abs(right) <= straightness) return true;
    const double x = 0.5 * (seed.left.at(y) + seed.right.at(y));
    return judged.refused.empty() && x > strip.left.at(y) && x < strip.right.at(y);
}

}  // namespace

EdgeSegmenter::EdgeSegmenter(const EdgeSegmentationParameters& parameters)
    : parameters_(parameters),
      left_finder_(parameters.posts),
      right_finder_(parameters.posts),
      seed_finder_(parameters.posts) {}

const Segments& EdgeSegmenter::segment(YuyvView image, const ScanLayout& layout,
                                       const CameraOverGround* view) {
    segments_.clear();
    segments_.width = image.width;
    segments_.height = image.height;
    frame_.rows.clear();
    frame_.edges.clear();
    frame_.first.clear();
    columns_.clear();
    strips_.clear();
    runs_.clear();
    field_.reset();
    if (image.empty()) return segments_;
    for (const int y : layout.rows)
        if (y >= 0 && y < image.height) frame_.rows.push_back(y);
    for (const int x : layout.columns)
        if (x >= 0 && x < image.width) columns_.push_back(x);

    double noise = survey(image);
    for (YuyvImage& blurred : blurred_) {
        if (noise <= parameters_.edges.most_noise) break;
        blur_vertically(image, blurred);
        image = blurred.view();
        noise = survey(image);
    }
    field_ = field_finder_.find(samples_, static_cast<float>(parameters_.field.least_share));
    find_edges(image);
    if (field_ && !ground_.empty()) find_posts(image, view);
    writer_.write(image, {frame_.rows, columns_, ground_, field_, runs_}, segments_);
    return segments_;
}

double EdgeSegmenter::survey(YuyvView image) {
    const EdgeParameters& edges = parameters_.edges;
    threshold_.window = window_pairs(edges, image.width);
    threshold_.chroma_weight = static_cast<float>(edges.chroma_weight);
    samples_.clear();
    sampled_steps_.clear();
    const std::size_t rows_apart = std::max<std::size_t>(1, frame_.rows.size() / survey_rows);
    for (std::size_t row = rows_apart / 2; row < frame_.rows.size(); row += rows_apart) {
        row_.load(image, frame_.rows[row], frame_.rows[std::min(row + rows_apart, frame_.rows.size() - 1)]);
        const auto steps = row_.squared_steps(threshold_.window, threshold_.chroma_weight);
        const float down = static_cast<float>(frame_.rows[row] + 1) / static_cast<float>(image.height);
        const int pairs_apart = std::max(1, row_.pairs() / survey_pairs);
        for (int i = threshold_.window; i + threshold_.window <= row_.pairs(); i += pairs_apart) {
            samples_.push_back({row_.mean(i, i + 1), down});
            sampled_steps_.push_back(steps[static_cast<std::size_t>(i)]);
        }
    }
    double noise = 0.0;
    if (!sampled_steps_.empty()) {
        const auto median = sampled_steps_.begin() + static_cast<std::ptrdiff_t>(sampled_steps_.size() / 2);
        std::nth_element(sampled_steps_.begin(), median, sampled_steps_.end());
        noise = std::sqrt(static_cast<double>(*median));
    }
    threshold_.strength = static_cast<float>(std::max(edges.least_strength, edges.noise_factor * noise));
    return noise;
}

void EdgeSegmenter::find_edges(YuyvView image) {
    ground_.begin(image, frame_.rows, columns_);
    for (std::size_t row = 0; row < frame_.rows.size(); ++row) {
        frame_.first.push_back(frame_.edges.size());
        row_.load(image, frame_.rows[row], frame_.rows[std::min(row + rows_ahead, frame_.rows.size() - 1)]);
        find_row_edges(row_, threshold_, field_, frame_.edges);
        if (field_) ground_.add_row(*field_);
    }
    frame_.first.push_back(frame_.edges.size());
    ground_.finish();
}

void EdgeSegmenter::find_posts(YuyvView image, const CameraOverGround* view) {
    const StripParameters& posts = parameters_.posts;
    const double straightness = straightness_px(posts, image.width);
    const auto darkest = static_cast<float>(share_of_brightness * posts.least_brightness) * field_->luma();
    const auto darkest_mean =
        static_cast<float>(share_of_mean_brightness * posts.least_brightness) * field_->luma();
    const auto left = left_finder_.find(frame_, ChainSide::left, threshold_, straightness, darkest);
    const auto right = right_finder_.find(frame_, ChainSide::right, threshold_, straightness, darkest);
    for (const StripSeed& seed :
         seed_finder_.find(frame_, left, right, threshold_.chroma_weight, straightness, image.width)) {
        if (strips_.size() == most_strips) break;
        if (seed.inside.y < darkest_mean) continue;
        if (std::any_of(strips_.begin(), strips_.end(),
                        [&](const JudgedStrip& s) { return known(seed, frame_, s, straightness); }))
            continue;
        JudgedStrip judged{grow_strip(image, frame_, seed, posts, threshold_, straightness, stretch_), ""};
        if (judged.strip.rows.empty()) continue;
        judged.refused = why_no_post(judged.strip, frame_, ground_, *field_, posts, threshold_, straightness,
                                     image.width, image.height, view)
                             .value_or("");
        strips_.push_back(std::move(judged));
    }
    // Of strips that touch the most distinct one stays.
    const auto merit = [](const UprightStrip& s) { return s.both * s.contrast; };
    std::stable_sort(strips_.begin(), strips_.end(), [&](const JudgedStrip& a, const JudgedStrip& b) {
        return merit(a.strip) > merit(b.strip);
    });
    for (std::size_t i = 0; i < strips_.size(); ++i) {
        if (!strips_[i].refused.empty()) continue;
        for (std::size_t j = 0; j < i; ++j) {
            if (strips_[j].refused.empty() && touch(strips_[i].strip, strips_[j].strip))
                strips_[i].refused = "lies in another or beside it";
        }
        if (!strips_[i].refused.empty()) continue;
        const UprightStrip& strip = strips_[i].strip;
        for (const StripRow& r : strip.rows) {
            // An edge that a row does not show lies where the other rows have it.
            const float from = r.left.value_or(static_cast<float>(strip.left.at(r.y)));
            const float to = r.right.value_or(static_cast<float>(strip.right.at(r.y)));
            if (to - from < 2.F || to < 2.F || from > static_cast<float>(image.width) - 3.F) continue;
            const auto row =
                std::lower_bound(frame_.rows.begin(), frame_.rows.end(), r.y) - frame_.rows.begin();
            runs_.push_back({static_cast<std::size_t>(row), from, to});
        }
    }
    std::sort(runs_.begin(), runs_.end(), [](const GoalRun& a, const GoalRun& b) {
        return a.row != b.row ? a.row < b.row : a.left < b.left;
    });
}

}  // namespace goalmouth
