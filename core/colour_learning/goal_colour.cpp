#include "core/colour_learning/goal_colour.h"

#include "core/colour_learning/level_counts.h"
#include "core/imaging/rgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace goalmouth {

namespace {

constexpr double least_goal = 0.5;  // of the pixels looked at
constexpr int fewest_pixels = 20;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::optional<Eigen::Vector3d> colour_of(YuyvView image, const Post& post, const ColourTable& table) {
    if (post.has(post_flag::left_edge_missing) || post.has(post_flag::right_edge_missing))
        return std::nullopt;
    constexpr double farthest = 1e5;  // px: what lies farther off is in no picture
    for (const Eigen::Vector2d* corner : {&post.left_top, &post.left_base, &post.right_top, &post.right_base})
        if (!(corner->cwiseAbs().maxCoeff() <= farthest)) return std::nullopt;
    std::array<LevelCounts, 3> rgb;
    int looked_at = 0, goal = 0;
    const double top = std::max(post.left_top.y(), post.right_top.y());
    const double base = std::min(post.left_base.y(), post.right_base.y());
    const int last = static_cast<int>(std::min(base, image.height - 1.0));
    for (int y = static_cast<int>(std::max(std::ceil(top), 0.0)); y <= last; ++y) {
        const auto x_at = [y](const Eigen::Vector2d& upper, const Eigen::Vector2d& lower) {
            return upper.x() +
                   (lower.x() - upper.x()) * (y - upper.y()) / std::max(1.0, lower.y() - upper.y());
        };
        const double left = x_at(post.left_top, post.left_base);
        const double right = x_at(post.right_top, post.right_base);
        const int from = static_cast<int>(std::max(std::ceil(left + 0.25 * (right - left)), 0.0));
        const int to = static_cast<int>(std::min(right - 0.25 * (right - left), image.width - 1.0));
        for (int x = from; x <= to; ++x) {
            const Ycbcr p = image.at(x, y);
            ++looked_at;
            if (table.at(p) != Colour::goal) continue;
            ++goal;
            const Rgb levels = rgb_of(p);
            rgb[0].add(levels.red);
            rgb[1].add(levels.green);
            rgb[2].add(levels.blue);
        }
    }
    if (goal < fewest_pixels || goal < least_goal * looked_at) return std::nullopt;
    return Eigen::Vector3d(rgb[0].median(), rgb[1].median(), rgb[2].median());
}

}  // namespace

std::vector<Eigen::Vector3d> post_colours(YuyvView image, std::span<const Post> posts,
                                          const ColourTable& table) {
    std::vector<Eigen::Vector3d> colours;
    for (const Post& post : posts)
        if (const auto colour = colour_of(image, post, table)) colours.push_back(*colour);
    return colours;
}

void GoalColour::see(const Eigen::Vector3d& rgb, const ColourGains& gains) {
    if (complete() || rgb.maxCoeff() >= clipped_level) return;
    const Eigen::Vector3d factors(gains.red, gains.green, gains.blue);
    if (factors.maxCoeff() > parameters_.largest_change ||
        factors.minCoeff() < 1.0 / parameters_.largest_change)
        return;
    seen_.push_back(rgb.cwiseQuotient(factors).cwiseMin(255.0).cwiseMax(1.0));
}

std::optional<Eigen::Vector3d> GoalColour::levels() const {
    if (seen_.size() < static_cast<std::size_t>(parameters_.least_posts)) return std::nullopt;
    Eigen::Vector3d colour;
    for (int c = 0; c < 3; ++c) {
        std::vector<double> values;
        for (const Eigen::Vector3d& rgb : seen_) values.push_back(rgb[c]);
        colour[c] = median(std::move(values));
    }
    return colour;
}

}  // namespace goalmouth
