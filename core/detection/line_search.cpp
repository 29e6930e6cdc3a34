#include "core/detection/line_search.h"

#include "core/detection/line_inliers.h"
#include "core/random/samples.h"

#include <algorithm>
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
        const PointColumns consensus{{consensus_x_.data(), best.support},
                                     {consensus_y_.data(), best.support}};
        if (const auto line = fit_line(consensus)) found_.push_back(edge_line(*line, consensus));
    }
    return found_;
}

void LineSearch::load(std::span<const Eigen::Vector2d> points) {
    count_ = points.size();
    const std::size_t room = count_ + room_behind_points;
    if (x_.size() < room) {
        for (auto* column : {&x_, &y_, &consensus_x_, &consensus_y_}) column->resize(room);
        on_grid_.resize(room);
        rounded_.resize(room);
    }
    const Box box = split_points(points, x_.data(), y_.data());
    grid_ = grid_for(box, parameters_.inlier_distance);
    if (grid_.scale > 0.0) place_on_grid(grid_, x_.data(), y_.data(), count_, on_grid_.data());
}

/// Of hypotheses with equal support the first, as everywhere in Algorithm 2.
LineSearch::Best LineSearch::best_hypothesis(Random& random) {
    const auto attempts = static_cast<std::size_t>(parameters_.attempts);
    const std::uint64_t key = random.bits();
    Best best;
    std::size_t drawn = 0;
    for (std::size_t needed = attempts; drawn < needed; drawn += samples_.count) {
        draw(key, drawn, std::min(LineSamples::most, needed - drawn));
        needed = search_samples(drawn, needed, best);
    }
    return best;
}

void LineSearch::draw(std::uint64_t key, std::size_t from, std::size_t count) {
    draw_pairs(key, from, static_cast<std::uint32_t>(count_), count, chosen_.data());
    for (std::size_t i = 0; i < count; ++i) {
        samples_.first[i] = on_grid_[chosen_[i] & 0xFFFFFFFFU];
        samples_.second[i] = on_grid_[chosen_[i] >> 32];
    }
    samples_.count = count;
}

/// Returns how many attempts are needed in all, now that these are known.
std::size_t LineSearch::search_samples(std::size_t drawn, std::size_t needed, Best& best) {
    SupportBounds bounds{static_cast<std::uint32_t>(count_), 0};
    if (grid_.scale > 0.0) {
        bounds =
            bound_support(samples_, grid_.near, on_grid_.data(), count_, rounded_.data(), support_.data());
    } else {
        support_.fill(bounds.most);
    }
    if (bounds.most < best.support) return needed;
    const bool in_order = parameters_.confidence < 1.0;
    if (!in_order && bounds.most > best.support) try_sample(bounds.first, drawn, best);
    // No bound before this one is as large, and none behind it larger.
    if (best.support == bounds.most) return best.support == count_ ? 0 : needed;
    for (std::size_t i = 0; i < samples_.count && drawn + i < needed; ++i) {
        if (support_[i] < best.support || (support_[i] == best.support && drawn + i >= best.attempt))
            continue;
        if (try_sample(i, drawn, best) && in_order)
            needed = attempts_needed(parameters_, best.support, count_, sample_size);
    }
    return best.support == count_ ? 0 : needed;
}

bool LineSearch::try_sample(std::size_t i, std::size_t drawn, Best& best) const {
    const auto point = [this](std::uint64_t j) { return Eigen::Vector2d(x_[j], y_[j]); };
    const auto line = line_through(point(chosen_[i] & 0xFFFFFFFFU), point(chosen_[i] >> 32));
    if (!line) return false;
    const std::size_t support =
        count_inliers(x_.data(), y_.data(), count_, *line, parameters_.inlier_distance);
    if (support < best.support || (support == best.support && drawn + i >= best.attempt)) return false;
    best = {*line, support, drawn + i};
    return true;
}

void LineSearch::take(const Line& line) {
    count_ -= take_inliers({x_.data(), y_.data(), on_grid_.data()}, count_, line, parameters_.inlier_distance,
                           consensus_x_.data(), consensus_y_.data());
}

std::vector<EdgeLine> find_lines(const std::vector<Eigen::Vector2d>& points,
                                 const RansacParameters& parameters, Random& random) {
    return LineSearch(parameters).find(points, random);
}

}  // namespace goalmouth
