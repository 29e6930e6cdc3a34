#include "core/refinement/far_levels.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr std::size_t count = 200;
constexpr float near_pairs = 2.0F, far_pairs = 3.0F, noise = 1.0F;

/// Rows whose far pixels inside differ by `difference(row)`; those outside by nothing but noise.
template <class Difference>
EdgeRows rows_with(Difference difference) {
    EdgeRows rows;
    rows.assign(count);
    std::mt19937 random(1);
    std::normal_distribution<float> deviate;
    for (std::size_t i = 0; i < count; ++i) {
        const auto mean_of = [&](float pairs) { return deviate(random) * std::sqrt(noise / pairs); };
        rows.weight[i] = 1.0F;
        rows.measured.own_inner[i] = mean_of(near_pairs);
        rows.measured.own_outer[i] = mean_of(near_pairs);
        rows.measured.own_inner_weight[i] = rows.measured.own_outer_weight[i] = near_pairs;
        rows.far_inner[i] = mean_of(far_pairs) + difference(i);
        rows.far_outer[i] = mean_of(far_pairs);
        rows.far_inner_pairs[i] = rows.far_outer_pairs[i] = far_pairs;
    }
    judge_far_levels(rows, noise);
    return rows;
}

float mean_weight(const RowColumn<float>& weight, std::size_t from = 0, std::size_t to = count) {
    float sum = 0.0F;
    for (std::size_t i = from; i < to; ++i) sum += weight[i];
    return sum / static_cast<float>(to - from);
}

TEST(FarLevels, CountAsPairsWhereTheyAreLikeThoseNearTheEdge) {
    const EdgeRows rows = rows_with([](std::size_t) { return 0.0F; });
    EXPECT_GT(mean_weight(rows.far_inner_weight), 0.6F * far_pairs);
    EXPECT_GT(mean_weight(rows.far_outer_weight), 0.6F * far_pairs);
    for (std::size_t i = 0; i < count; ++i) EXPECT_LE(rows.far_inner_weight[i], 1.001F * far_pairs);
}

TEST(FarLevels, CountForLittleWhereAllRowsDifferAlike) {
    // Half a sigma of one row: no row shows it, all together do.
    const EdgeRows rows = rows_with([](std::size_t) { return 0.5F * std::sqrt(noise / far_pairs); });
    EXPECT_LT(mean_weight(rows.far_inner_weight), 0.1F * far_pairs);
    EXPECT_GT(mean_weight(rows.far_outer_weight), 0.6F * far_pairs);
}

TEST(FarLevels, CountForLittleInRowsThatDifferEachItsOwnWay) {
    const EdgeRows rows = rows_with([](std::size_t i) {
        const bool there = i >= 80 && i < 120;
        return there ? (i % 2 == 0 ? 6.0F : -6.0F) : 0.0F;
    });
    EXPECT_LT(mean_weight(rows.far_inner_weight, 80, 120), 0.05F * far_pairs);
    EXPECT_GT(mean_weight(rows.far_inner_weight, 0, 60), 0.6F * far_pairs);
}

TEST(FarLevels, CountForNothingWhereNoneAreReadOrNoRowCounts) {
    EdgeRows rows = rows_with([](std::size_t) { return 0.0F; });
    rows.far_inner_weight.assign(count);
    rows.far_inner_pairs.assign(count);
    rows.far_outer_weight.assign(count);
    rows.weight.assign(count);
    judge_far_levels(rows, noise);
    EXPECT_EQ(mean_weight(rows.far_inner_weight), 0.0F);
    EXPECT_EQ(mean_weight(rows.far_outer_weight), 0.0F);
}

}  // namespace
}  // namespace goalmouth
