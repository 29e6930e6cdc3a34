#include "core/evaluation/visible_post.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

std::optional<ReferencePost> visible_outline(const TruePost& post, const std::array<EdgePath, 2>& edges,
                                             const Intrinsics& camera, const CountingRule& rule) {
    const auto& [left, right] = edges;
    if (left.empty() || right.empty()) return std::nullopt;

    constexpr double first = -0.5;
    const double last_x = camera.width - 0.5;
    const double last_y = camera.height - 0.5;
    const double top = std::max(std::min(left.top(), right.top()), first);
    const double base = std::min(std::max(left.base(), right.base()), last_y);
    if (!(top < base)) return std::nullopt;

    // In pieces finer than a row: where some of the post, and where all of its width, lies inside.
    const int pieces = static_cast<int>(std::ceil(4.0 * (base - top)));
    const double piece = (base - top) / pieces;
    int whole = 0;
    int first_seen = -1;
    int last_seen = -1;
    for (int i = 0; i < pieces; ++i) {
        const double row = top + (i + 0.5) * piece;
        const double l = left.x_at(row);
        const double r = right.x_at(row);
        if (r < first || l > last_x) continue;
        if (first_seen < 0) first_seen = i;
        last_seen = i;
        if (l >= first && r <= last_x) ++whole;
    }
    if (first_seen < 0) return std::nullopt;
    const double seen_top = top + first_seen * piece;
    const double seen_base = top + (last_seen + 1) * piece;

    ReferencePost outline{left.at(seen_top), left.at(seen_base), right.at(seen_top), right.at(seen_base)};
    const double hidden = post.inside > 0.0 ? 1.0 - post.visible / post.inside : 1.0;
    outline.counts =
        static_cast<double>(whole) / pieces >= rule.least_inside && hidden <= rule.largest_hidden;
    return outline;
}

double bearing_in_row(const ReferencePost& outline, const Intrinsics& camera, double row) {
    const auto x_at = [row](const Eigen::Vector2d& top, const Eigen::Vector2d& base) {
        const double length = base.y() - top.y();
        return length > 0.0 ? top.x() + (row - top.y()) / length * (base.x() - top.x())
                            : 0.5 * (top.x() + base.x());
    };
    const double x =
        0.5 * (x_at(outline.left_top, outline.left_base) + x_at(outline.right_top, outline.right_base));
    return -std::atan(normalised_from_pixel(camera, {x, row}).x());
}

}  // namespace goalmouth
