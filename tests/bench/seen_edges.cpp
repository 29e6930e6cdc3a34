#include "tests/bench/stages.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace goalmouth::bench {
namespace {

constexpr double tolerance = 0.25;  // of the post's width
constexpr double heights[] = {0.25, 0.5, 0.75};
constexpr int heights_needed = 2;

bool passes(const SeenEdge& edge, double x, double y, double largest_distance) {
    const auto& [upper, lower] =
        edge.from.y() <= edge.to.y() ? std::tie(edge.from, edge.to) : std::tie(edge.to, edge.from);
    if (y < upper.y() || y > lower.y() || upper.y() == lower.y()) return false;
    const double at = std::lerp(upper.x(), lower.x(), (y - upper.y()) / (lower.y() - upper.y()));
    return std::abs(at - x) <= largest_distance;
}

bool is_seen(const Eigen::Vector2d& top, const Eigen::Vector2d& base, double width,
             const std::vector<SeenEdge>& edges) {
    int hits = 0;
    for (const double height : heights) {
        const Eigen::Vector2d place = top + height * (base - top);
        const bool hit = std::any_of(edges.begin(), edges.end(), [&](const SeenEdge& edge) {
            return passes(edge, place.x(), place.y(), tolerance * width);
        });
        if (hit) ++hits;
    }
    return hits >= heights_needed;
}

}  // namespace

void count_seen_edges(const std::vector<ReferencePost>& posts, const std::vector<SeenEdge>& edges,
                      std::size_t& seen, std::size_t& asked) {
    for (const ReferencePost& post : posts) {
        if (!post.counts) continue;
        const double width =
            0.5 * ((post.right_top - post.left_top).norm() + (post.right_base - post.left_base).norm());
        asked += 2;
        if (is_seen(post.left_top, post.left_base, width, edges)) ++seen;
        if (is_seen(post.right_top, post.right_base, width, edges)) ++seen;
    }
}

}  // namespace goalmouth::bench
