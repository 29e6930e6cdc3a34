#pragma once

#include "core/detection/ransac_parameters.h"
#include "core/random/random.h"
#include "core/random/samples.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// A primitive and the points that agree with it.
template <class Primitive>
struct Consensus {
    Primitive primitive;                  // fitted to all points of the consensus set
    std::vector<Eigen::Vector2d> points;  // px, the consensus set, in the order of the input
};

/// Algorithm 2 of the paper: RANSAC for several models in one set of points, for any primitive, as the paper
/// writes it. Lines have a faster way to the same result (line_search.h).
///
/// A Primitive P has
///
///     static constexpr std::size_t sample_size;                          points that define one
///     static std::optional<P> through(std::span<const Eigen::Vector2d>); a sample; nothing if degenerate
///     static std::optional<P> fit(std::span<const Eigen::Vector2d>);     least squares
///     double distance(const Eigen::Vector2d&) const;                     px
///
/// Errors in the text, mended by their evident intent:
///   * the loop ends when |L| = M_max models are found (the text compares |P_best|);
///   * a model is accepted when |P_best| ≥ n (the text tests |P_inliers|, the last hypothesis's set).
/// And where the text is silent: the sample's points are different ones of the set, for each model those of a
/// key drawn from `random` (core/random/samples.h); a degenerate sample uses up its attempt; of consensus
/// sets of equal size the first stays; where not one attempt found any inlier (all points equal), the search
/// ends, because P would never shrink; a consensus set without a least-squares fit is removed like one that
/// is too small.
template <class Primitive>
std::vector<Consensus<Primitive>> find_primitives(std::vector<Eigen::Vector2d> points,
                                                  const RansacParameters& parameters, Random& random) {
    constexpr std::size_t sample_size = Primitive::sample_size;
    const auto minimum = std::max(static_cast<std::size_t>(parameters.minimum_points), sample_size);
    std::vector<Consensus<Primitive>> found;  // L
    while (points.size() >= minimum && found.size() < static_cast<std::size_t>(parameters.maximum_models)) {
        std::vector<char> best(points.size(), 0);  // P_best as a mask over P
        std::size_t best_count = 0;
        auto needed = static_cast<std::size_t>(parameters.attempts);
        const std::uint64_t key = random.bits();
        const auto size = static_cast<std::uint32_t>(points.size());
        for (std::size_t attempt = 0; attempt < needed; ++attempt) {
            const auto indices = draw_sample<sample_size>(key, attempt, size);
            std::array<Eigen::Vector2d, sample_size> sample;
            for (std::size_t i = 0; i < sample_size; ++i) sample[i] = points[indices[i]];
            const auto hypothesis = Primitive::through(sample);
            if (!hypothesis) continue;
            std::vector<char> inliers(points.size(), 0);
            std::size_t count = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                inliers[i] = hypothesis->distance(points[i]) < parameters.inlier_distance;
                count += static_cast<std::size_t>(inliers[i]);
            }
            if (count > best_count) {
                best_count = count;
                best.swap(inliers);
                needed = attempts_needed(parameters, best_count, points.size(), sample_size);
            }
        }
        if (best_count == 0) break;

        std::vector<Eigen::Vector2d> consensus;
        std::vector<Eigen::Vector2d> rest;
        for (std::size_t i = 0; i < points.size(); ++i) (best[i] ? consensus : rest).push_back(points[i]);
        if (best_count >= minimum) {
            if (const auto primitive = Primitive::fit(consensus))
                found.push_back({*primitive, std::move(consensus)});
        }
        points = std::move(rest);
    }
    return found;
}

}  // namespace goalmouth
