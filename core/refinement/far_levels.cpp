#include "core/refinement/far_levels.h"

#include <algorithm>

namespace goalmouth {
namespace {

constexpr std::size_t reach = 12;  // rows on either side
constexpr float fewest = 0.5F;     // pairs
constexpr double chance = 2.0;     // sigmas by which all rows may differ alike

void judge(const EdgeRows& rows, float noise, const RowColumn<float>& near,
           const RowColumn<float>& near_pairs, const RowColumn<float>& far, const RowColumn<float>& far_pairs,
           RowColumn<float>& weight) {
    const auto told = [&](std::size_t i) {
        return rows.weight[i] > 0.0F && near_pairs[i] > fewest && far_pairs[i] > fewest;
    };
    // Sums over the rows before each: of what differs, of what noise explains, and of the rows that tell.
    RowColumn<float> squares, counts;
    squares.assign(rows.count + 1);
    counts.assign(rows.count + 1);
    double difference = 0.0, weights = 0.0;
    for (std::size_t i = 0; i < rows.count; ++i) {
        squares[i + 1] = squares[i];
        counts[i + 1] = counts[i];
        if (!told(i)) continue;
        const float d = far[i] - near[i];
        const float variance = noise * (1.0F / near_pairs[i] + 1.0F / far_pairs[i]);
        squares[i + 1] += d * d - variance;
        counts[i + 1] += 1.0F;
        difference += static_cast<double>(d / variance);
        weights += static_cast<double>(1.0F / variance);
    }
    const float all = counts[rows.count];
    const double mean = weights > 0.0 ? difference / weights : 0.0;
    const double shared = weights > 0.0 ? std::max(0.0, mean * mean - chance * chance / weights) : 0.0;
    const float of_all = static_cast<float>(shared) * all;
    for (std::size_t i = 0; i < rows.count; ++i) {
        const std::size_t from = i - std::min(i, reach), to = std::min(rows.count, i + reach + 1);
        const float count = counts[to] - counts[from];
        if (!(far_pairs[i] > fewest) || !(count > 0.0F)) continue;
        const float differs = std::max(0.0F, (squares[to] - squares[from]) / count);
        weight[i] = 1.0F / (1.0F / far_pairs[i] + (differs + of_all) / noise);
    }
}

}  // namespace

void judge_far_levels(EdgeRows& rows, float noise) {
    const RowMeasurements& m = rows.measured;
    judge(rows, noise, m.own_inner, m.own_inner_weight, rows.far_inner, rows.far_inner_pairs,
          rows.far_inner_weight);
    judge(rows, noise, m.own_outer, m.own_outer_weight, rows.far_outer, rows.far_outer_pairs,
          rows.far_outer_weight);
}

}  // namespace goalmouth
