#include "core/colour_learning/salient_colour.h"

#include "core/colour_learning/standing_posts.h"
#include "core/imaging/colour_rules.h"
#include "core/imaging/colour_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace goalmouth {

namespace {

using Slice = std::function<bool(Ycbcr)>;

/// Every cell by the colour in its middle; what the field has is never the goal's.
ColourTable table_of(const Slice& slice, const ChromaRegion& field) {
    ColourTable table(6);
    for (int cb = 2; cb < 256; cb += 4) {
        for (int cr = 2; cr < 256; cr += 4) {
            for (int y = 2; y < 256; y += 4) {
                const Ycbcr p{static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                              static_cast<std::uint8_t>(cr)};
                if (field.holds(p)) {
                    table.set(p, Colour::field);
                } else if (slice(p)) {
                    table.set(p, Colour::goal);
                }
            }
        }
    }
    return table;
}

/// Hues nearer to yellow (171°) than to red (109°) or green (232°), in overlapping slices.
std::vector<Slice> yellow_slices() {
    std::vector<Slice> slices;
    for (double hue = 144.0; hue <= 200.0; hue += 7.0) {
        for (const double saturation : {0.15, 0.25, 0.4}) {
            ColourRule rule;
            rule.hue = {hue - 14.0, hue + 14.0};
            rule.saturation = {saturation, 182.0};
            rule.chroma = {12.0, 182.0};
            slices.emplace_back([rule](Ycbcr p) { return rule.fits(p); });
        }
    }
    return slices;
}

/// Mean colour of what is bright on the ground in the lines' chroma.
struct Paint {
    double y = 0.0;
    double cb = 0.0;  // from neutral
    double cr = 0.0;
};

std::optional<Paint> mean_paint(std::span<const YuyvImage> pictures, const ChromaRegion& field,
                                const ChromaRegion& line) {
    Paint sum;
    double count = 0.0;
    for (const YuyvImage& picture : pictures) {
        const YuyvView image = picture.view();
        const cv::Mat like_field = mask_of(image, [&](Ycbcr p) { return field.holds(p); });
        const cv::Mat paint = brighter_than_field(image, like_field) &
                              pitch_mask(like_field, image_scale(image.width));
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const Ycbcr p = image.at(x, y);
                if (!paint.at<std::uint8_t>(y, x) || !line.holds(p)) continue;
                sum.y += p.y;
                sum.cb += p.cb - 128.0;
                sum.cr += p.cr - 128.0;
                count += 1.0;
            }
        }
    }
    if (count == 0.0) return std::nullopt;
    return Paint{sum.y / count, sum.cb / count, sum.cr / count};
}

/// White is what the lines are: the same chroma for the same light, brighter than so much of theirs.
std::vector<Slice> white_slices(const Paint& paint) {
    std::vector<Slice> slices;
    for (const double share : {0.6, 0.8, 1.0}) {
        for (const double near : {0.12, 0.2}) {
            slices.emplace_back([paint, share, near](Ycbcr p) {
                const double off_cb = (p.cb - 128.0) / std::max<double>(p.y, 1.0) - paint.cb / paint.y;
                const double off_cr = (p.cr - 128.0) / std::max<double>(p.y, 1.0) - paint.cr / paint.y;
                return p.y >= share * paint.y && std::hypot(off_cb, off_cr) <= near;
            });
        }
    }
    return slices;
}

SalientGoal looked_at(std::span<const YuyvImage> pictures, const ColourTable& table) {
    SalientGoal goal;
    goal.posts = standing_posts(pictures, table);
    if (std::all_of(goal.posts.begin(), goal.posts.end(), [](const auto& posts) { return posts.empty(); }))
        return goal;
    GoalColourScore score;
    double pixels = 0.0;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        score += score_goal_colour(pictures[i].view(), goal.posts[i], {}, table);
        pixels += static_cast<double>(pictures[i].width) * pictures[i].height;
    }
    if (score.inside_goal == 0) return goal;
    const auto inside = static_cast<double>(score.inside_goal);
    goal.area = inside / pixels;
    goal.filled = inside / static_cast<double>(score.inside);
    goal.salience = inside / (inside + static_cast<double>(score.elsewhere_goal));
    return goal;
}

}  // namespace

GoalPaint goal_paint(const std::string& name) {
    if (name == "yellow") return GoalPaint::yellow;
    if (name == "white") return GoalPaint::white;
    throw std::invalid_argument("goals are yellow or white, not \"" + name + "\"");
}

std::optional<SalientGoal> find_goal(std::span<const YuyvImage> pictures, const ChromaRegion& field,
                                     const std::optional<ChromaRegion>& line, GoalPaint paint) {
    std::vector<Slice> slices;
    if (paint == GoalPaint::yellow) {
        slices = yellow_slices();
    } else if (line) {
        if (const auto white = mean_paint(pictures, field, *line)) slices = white_slices(*white);
    }
    std::optional<SalientGoal> best;
    for (const Slice& slice : slices) {
        SalientGoal goal = looked_at(pictures, table_of(slice, field));
        if (goal.score() > (best ? best->score() : 0.0)) best = std::move(goal);
    }
    return best;
}

}  // namespace goalmouth
