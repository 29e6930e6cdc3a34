#include "core/colour_learning/salient_colour.h"

#include "core/colour_learning/standing_posts.h"
#include "core/imaging/colour_rules.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/rgb.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace goalmouth {

namespace {

/// Mean colour of the lines.
using Paint = LumaChroma;
constexpr Paint neutral_white{255.0, 0.0, 0.0};

/// The colour in the middle of a cell, as it is and as it would be were the lines white.
struct Cell {
    Ycbcr p;
    ChromaPolar balanced;
};

using Slice = std::function<bool(const Cell&)>;

/// Red, green and blue divided by what white has of them (von Kries). A channel of which the light has next
/// to nothing is not blown up beyond fourfold: it is noise.
ChromaPolar balanced(Ycbcr p, const Paint& white) {
    const Rgb paint = rgb_of(white.y, white.cb, white.cr);
    const auto share = [&](double of_white) { return std::max(of_white / white.y, 0.25); };
    const Rgb seen = rgb_of(p);
    const LumaChroma under_white = luma_chroma_of(
        {seen.red / share(paint.red), seen.green / share(paint.green), seen.blue / share(paint.blue)});
    return chroma_polar(under_white.y, under_white.cb, under_white.cr);
}

std::vector<Cell> cells(const Paint& white) {
    std::vector<Cell> all;
    for (int cb = 2; cb < 256; cb += 4) {
        for (int cr = 2; cr < 256; cr += 4) {
            for (int y = 2; y < 256; y += 4) {
                const Ycbcr p{static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                              static_cast<std::uint8_t>(cr)};
                all.push_back({p, balanced(p, white)});
            }
        }
    }
    return all;
}

/// What the field has is never the goal's.
ColourTable table_of(const Slice& slice, const std::vector<Cell>& all, const ChromaRegion& field) {
    ColourTable table(6);
    for (const Cell& cell : all) {
        if (field.holds(cell.p)) {
            table.set(cell.p, Colour::field);
        } else if (slice(cell)) {
            table.set(cell.p, Colour::goal);
        }
    }
    return table;
}

/// Hues nearer to yellow (171°) than to red (109°) or green (232°), in overlapping slices.
std::vector<Slice> yellow_slices() {
    std::vector<Slice> slices;
    for (double hue = 144.0; hue <= 200.0; hue += 7.0) {
        for (const double saturation : {0.15, 0.25, 0.4}) {
            slices.emplace_back([hue, saturation](const Cell& cell) {
                return std::abs(cell.balanced.hue - hue) <= 14.0 && cell.balanced.saturation >= saturation &&
                       cell.balanced.chroma >= 12.0;
            });
        }
    }
    return slices;
}

/// Of what is bright on the ground in the lines' chroma.
std::optional<Paint> mean_paint(std::span<const YuyvImage> pictures, const ChromaRegion& field,
                                const ChromaRegion& line) {
    Paint sum;
    double count = 0.0;
    for (const YuyvImage& picture : pictures) {
        const YuyvView image = picture.view();
        const cv::Mat like_field = mask_of(image, [&](Ycbcr p) { return field.holds(p); });
        const cv::Mat paint =
            brighter_than_field(image, like_field) & pitch_mask(like_field, image_scale(image.width));
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
            slices.emplace_back([paint, share, near](const Cell& cell) {
                const Ycbcr p = cell.p;
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
    const std::optional<Paint> white = line ? mean_paint(pictures, field, *line) : std::nullopt;
    std::vector<Slice> slices;
    if (paint == GoalPaint::yellow) {
        slices = yellow_slices();
    } else if (white) {
        slices = white_slices(*white);
    }
    const std::vector<Cell> all = cells(white.value_or(neutral_white));
    std::optional<SalientGoal> best;
    for (const Slice& slice : slices) {
        SalientGoal goal = looked_at(pictures, table_of(slice, all, field));
        if (goal.score() > (best ? best->score() : 0.0)) best = std::move(goal);
    }
    return best;
}

}  // namespace goalmouth
