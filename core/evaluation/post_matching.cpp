#include "core/evaluation/post_matching.h"

#include "core/geometry/line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace goalmouth {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 2> heights = {0.25, 0.75};  // down the visible length

struct Rows {
    double top = 0.0;
    double base = 0.0;
    double length() const { return std::max(0.0, base - top); }
};

/// A leaning post's edges start and end in different rows: what lies between their means is its length.
template <class Outline>
Rows rows_of(const Outline& post) {
    return {0.5 * (post.left_top.y() + post.right_top.y()), 0.5 * (post.left_base.y() + post.right_base.y())};
}

/// x of the straight line through two points at a row; infinite where it is level.
double x_at(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double row) {
    const auto line = line_through(a, b);
    const auto x = line ? line->x_at(row) : std::nullopt;
    return x && std::isfinite(*x) ? *x : infinity;
}

struct Crossing {
    double left = 0.0;
    double right = 0.0;
};

template <class Outline>
Crossing crossing(const Outline& post, double row) {
    return {x_at(post.left_top, post.left_base, row), x_at(post.right_top, post.right_base, row)};
}

/// Largest offset of an edge as a share of what the rule allows, where the rule holds.
std::optional<double> agreement(const ReferencePost& truth, const Post& detection, const MatchingRule& rule) {
    const Rows true_rows = rows_of(truth);
    if (!(true_rows.length() > 0.0)) return std::nullopt;
    const Rows found_rows = rows_of(detection);
    const Rows common{std::max(true_rows.top, found_rows.top), std::min(true_rows.base, found_rows.base)};
    if (!(common.length() >= rule.coverage * true_rows.length())) return std::nullopt;

    double worst = 0.0;
    for (const double height : heights) {
        const double row = true_rows.top + height * true_rows.length();
        const Crossing wanted = crossing(truth, row);
        const Crossing found = crossing(detection, row);
        const double width = std::abs(wanted.right - wanted.left);
        const double limit = std::max(rule.fraction * width, rule.floor);
        const double off = std::max(std::abs(found.left - wanted.left), std::abs(found.right - wanted.right));
        if (!(off <= limit)) return std::nullopt;
        worst = std::max(worst, limit > 0.0 ? off / limit : 0.0);
    }
    return worst;
}

template <class Outline>
Eigen::Vector2d middle(const Outline& post) {
    return 0.25 * (post.left_top + post.left_base + post.right_top + post.right_base);
}

template <class Outline>
bool encloses(const Outline& post, const Eigen::Vector2d& p) {
    const std::array<Eigen::Vector2d, 4> corners = {post.left_top, post.right_top, post.right_base,
                                                    post.left_base};
    bool inside = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d& a = corners[i];
        const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
}

struct Pair {
    double cost = 0.0;
    std::size_t truth = 0;
    std::size_t detection = 0;
};

/// Takes pairs, the cheapest first, whose post and detection are both still free in `of_truth`.
void assign(std::vector<Pair> pairs, std::vector<std::optional<std::size_t>>& of_truth,
            std::vector<bool>& taken) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
    for (const Pair& pair : pairs) {
        if (of_truth[pair.truth] || taken[pair.detection]) continue;
        of_truth[pair.truth] = pair.detection;
        taken[pair.detection] = true;
    }
}

}  // namespace

std::size_t PostMatching::found_count(std::span<const ReferencePost> truth) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (truth[i].counts && found[i]) ++count;
    return count;
}

std::size_t PostMatching::wrong_count() const {
    return static_cast<std::size_t>(std::count(verdicts.begin(), verdicts.end(), Verdict::wrong));
}

PostMatching match_posts(std::span<const ReferencePost> truth, std::span<const Post> detections,
                         const MatchingRule& rule, std::span<const Eigen::AlignedBox2d> ignore) {
    PostMatching result;
    result.found.resize(truth.size());
    result.verdicts.assign(detections.size(), Verdict::wrong);

    std::vector<Pair> agreeing;
    std::vector<Pair> near;
    for (std::size_t t = 0; t < truth.size(); ++t) {
        const Eigen::Vector2d wanted = middle(truth[t]);
        for (std::size_t d = 0; d < detections.size(); ++d) {
            if (const auto cost = agreement(truth[t], detections[d], rule)) agreeing.push_back({*cost, t, d});
            const Eigen::Vector2d found = middle(detections[d]);
            if (encloses(truth[t], found) || encloses(detections[d], wanted))
                near.push_back({(found - wanted).norm(), t, d});
        }
    }
    std::vector<bool> taken(detections.size(), false);
    assign(std::move(agreeing), result.found, taken);
    result.identified = result.found;
    assign(std::move(near), result.identified, taken);

    for (std::size_t t = 0; t < truth.size(); ++t) {
        if (!truth[t].counts) {
            if (result.identified[t]) result.verdicts[*result.identified[t]] = Verdict::ignored;
        } else if (result.found[t]) {
            result.verdicts[*result.found[t]] = Verdict::found;
        }
    }
    for (std::size_t d = 0; d < detections.size(); ++d) {
        if (result.verdicts[d] != Verdict::wrong) continue;
        const Eigen::Vector2d where = middle(detections[d]);
        if (std::any_of(ignore.begin(), ignore.end(), [&](const auto& box) { return box.contains(where); }))
            result.verdicts[d] = Verdict::ignored;
    }
    return result;
}

std::array<double, 2> edge_offsets(const ReferencePost& truth, const Post& detection) {
    const Rows rows = rows_of(truth);
    std::array<double, 2> mean{};
    for (const double height : heights) {
        const double row = rows.top + height * rows.length();
        const Crossing wanted = crossing(truth, row);
        const Crossing found = crossing(detection, row);
        mean[0] += (found.left - wanted.left) / static_cast<double>(heights.size());
        mean[1] += (found.right - wanted.right) / static_cast<double>(heights.size());
    }
    return mean;
}

}  // namespace goalmouth
