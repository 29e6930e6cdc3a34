#include "core/detection/line_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace goalmouth {
namespace {

constexpr std::size_t sample_size = 2;

}  // namespace

const std::vector<EdgeLine>& LineSearch::find(std::span<const Eigen::Vector2d> points, Random& random) {
    const auto minimum = std::max(static_cast<std::size_t>(parameters_.minimum_points), sample_size);
    const auto most = static_cast<std::size_t>(parameters_.maximum_models);
    found_.clear();
    load(points);
    while (count_ >= minimum && found_.size() < most) {
        const Best best = best_hypothesis(random);
        if (best.support == 0) break;
        take(best.line);
        if (best.support < minimum) continue;
        const std::span consensus(consensus_.data(), best.support);
        if (const auto line = fit_line(consensus)) found_.push_back(edge_line(*line, consensus));
    }
    return found_;
}

void LineSearch::load(std::span<const Eigen::Vector2d> points) {
    count_ = points.size();
    const std::size_t room = count_ + room_behind_points;
    if (points_.size() < room) {
        points_.resize(room, Eigen::Vector2d::Zero());
        consensus_.resize(room, Eigen::Vector2d::Zero());
        coarse_.resize(room);
        order_.resize(room);
    }
    std::copy(points.begin(), points.end(), points_.begin());
}

/// Of hypotheses with equal support the first, as everywhere in Algorithm 2.
LineSearch::Best LineSearch::best_hypothesis(Random& random) {
    const double reach = coarse_points(points_.data(), count_, coarse_.data());
    coarse_distance_ = coarse_distance(parameters_.inlier_distance, points_[0], reach);
    std::iota(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(count_), 0U);
    const auto attempts = static_cast<std::size_t>(parameters_.attempts);
    Best best;
    std::size_t drawn = 0;
    for (std::size_t needed = attempts; drawn < needed;) {
        draw(std::min(LineSamples::most, attempts - drawn), random);
        needed = search_samples(drawn, needed, best);
        drawn += samples_.count;
    }
    const auto points = static_cast<std::uint32_t>(count_);
    for (; drawn < attempts; ++drawn) {
        random.index(points);
        random.index(points - 1);
    }
    return best;
}

void LineSearch::draw(std::size_t count, Random& random) {
    const auto points = static_cast<std::uint32_t>(count_);
    std::uint32_t* const order = order_.data();
    Random draws = random;  // a copy stays in registers
    std::uint32_t first = order[0];
    for (std::size_t i = 0; i < count; ++i) {
        // std::swap(order[0], order[index(n)]), std::swap(order[1], order[1 + index(n - 1)]), with order[0]
        // kept at hand.
        order[0] = first;
        std::uint32_t& a = order[draws.index(points)];
        std::swap(first, a);
        std::uint32_t& b = order[1 + draws.index(points - 1)];
        const std::uint32_t second = b;
        b = order[1];
        order[1] = second;
        first_[i] = first;
        second_[i] = second;
    }
    order[0] = first;
    random = draws;
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector2d& a = points_[first_[i]];
        const Eigen::Vector2d& b = points_[second_[i]];
        samples_.point[i] = coarse_[first_[i]];
        samples_.along[i] = (b - a).cast<float>();
    }
    samples_.count = count;
}

/// Returns how many attempts are needed in all, now that these are known.
std::size_t LineSearch::search_samples(std::size_t drawn, std::size_t needed, Best& best) {
    auto most = static_cast<std::uint32_t>(count_);
    if (std::isinf(coarse_distance_)) {
        support_.fill(most);
    } else {
        most = bound_support(samples_, coarse_.data(), count_, coarse_distance_, support_.data());
    }
    if (most < best.support) return needed;
    const bool in_order = parameters_.confidence < 1.0;
    if (!in_order && most > best.support) {
        const auto promising = std::find(support_.begin(), support_.end(), most) - support_.begin();
        try_sample(static_cast<std::size_t>(promising), drawn, best);
    }
    // No bound before this one is as large, and none behind it larger.
    if (best.support == most) return most == count_ ? 0 : needed;
    for (std::size_t i = 0; i < samples_.count && drawn + i < needed; ++i) {
        if (support_[i] < best.support || (support_[i] == best.support && drawn + i >= best.attempt))
            continue;
        if (try_sample(i, drawn, best) && in_order)
            needed = attempts_needed(parameters_, best.support, count_, sample_size);
    }
    return best.support == count_ ? 0 : needed;
}

bool LineSearch::try_sample(std::size_t i, std::size_t drawn, Best& best) const {
    const auto line = line_through(points_[first_[i]], points_[second_[i]]);
    if (!line) return false;
    const std::size_t support = count_inliers(points_.data(), count_, *line, parameters_.inlier_distance);
    if (support < best.support || (support == best.support && drawn + i >= best.attempt)) return false;
    best = {*line, support, drawn + i};
    return true;
}

void LineSearch::take(const Line& line) {
    count_ -= take_inliers(points_.data(), count_, line, parameters_.inlier_distance, consensus_.data());
}

std::vector<EdgeLine> find_lines(const std::vector<Eigen::Vector2d>& points,
                                 const RansacParameters& parameters, Random& random) {
    return LineSearch(parameters).find(points, random);
}

}  // namespace goalmouth
