#include "tests/support/vector_targets.h"

#include "core/random/random.h"
#include "core/refinement/edge_row_reader.h"
#include "core/refinement/end_equations.h"
#include "core/refinement/level_smoother.h"
#include "core/refinement/piece_evidence.h"
#include "core/refinement/post_refiner.h"
#include "core/refinement/row_differences.h"
#include "core/refinement/row_measurement.h"
#include "core/refinement/row_pixels.h"
#include "core/refinement/row_purity.h"
#include "tests/core/refinement/drawn_post.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

/// A post whose edges lean, with noise, through a lens.
DrawnPost leaning_scene() {
    DrawnPost scene = small_scene();
    scene.camera.distortion = {-0.2, 0.03, 0.001, -0.001, 0.0};
    scene.roll = 0.2;
    return scene;
}

/// Bit for bit.
template <class T>
void expect_same(const std::optional<T>& first, const T& here) {
    if (first) {
        EXPECT_EQ(*first, here);
    }
}

std::vector<float> numbers_of(const RowColumn<float>& column, std::size_t rows) {
    return {column.data(), column.data() + rows};
}

TEST(RefinementVectors, EveryKindOfThemMeasuresTheSame) {
    const DrawnPost scene = leaning_scene();
    const YuyvImage image = scene.draw();
    for (const char* response : {"linear", "srgb"}) {
        RefinementParameters parameters;
        parameters.response = response;
        std::optional<std::vector<double>> first;
        on_each_vector_target([&] {
            PostRefiner refiner(parameters, {});
            const RefinedPost refined =
                refiner.refine(image.view(), {scene.found(0.8, -0.7)}, scene.camera, scene.pose()).front();
            ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
            const Eigen::Matrix2d& c = refined.post.covariance;
            const std::vector<double> here = {
                refined.post.distance_m, refined.post.bearing_rad, c(0, 0), c(0, 1), c(1, 1),
                refined.quality,         refined.left->plane.x()};
            expect_same(first, here);
            first = here;
        });
    }
}

TEST(RefinementVectors, EveryKindOfThemJudgesRowsTheSame) {
    Random random(7);
    const std::size_t count = 75;  // no whole number of vectors
    StepProfile profile;
    profile.set_blur(1.3, 0.4);
    std::optional<std::vector<float>> first;
    EdgeRows drawn;
    drawn.assign(count);
    SupposedEdges edges;
    edges.start.assign(count);
    edges.across.assign(count);
    for (std::size_t i = 0; i < count; ++i) {
        drawn.pairs[i] = static_cast<float>(i % 9 == 4 ? 0 : 5 + i % 12);
        drawn.first[i] = random.uniform(40.0, 42.0);
        drawn.edge[i] = drawn.first[i] + random.uniform(5.0, 9.0);
        drawn.outer[i] = static_cast<float>(random.uniform(20.0, 40.0));
        drawn.other_edge[i] = drawn.outer[i];
        drawn.inner_variance[i] = 1.0F, drawn.outer_variance[i] = 30.0F;
        edges.start[i] = static_cast<float>(drawn.first[i] - drawn.edge[i]);
        edges.across[i] = i % 3 == 0 ? 9.0F : 0.0F;
        for (std::size_t k = 0; k < EdgeRows::most_pairs; ++k) {
            EdgeRows::Pixels& pixels = drawn.pixels[i / EdgeRows::block];
            const float share = profile.at(edges.start[i] + 2.0F * static_cast<float>(k) - 0.3F).step;
            pixels.value[k][i % EdgeRows::block] =
                drawn.outer[i] * share + static_cast<float>(random.normal());
            pixels.stray[k][i % EdgeRows::block] = static_cast<float>(random.normal());
            pixels.luma[k][i % EdgeRows::block] =
                120.0F - 60.0F * share + static_cast<float>(random.normal());
        }
    }
    on_each_vector_target([&] {
        EdgeRows rows = drawn;
        BlurRows blur;
        blur.assign(count);
        measure_rows(rows, profile, edges, 1.0F, 1.2F, nullptr, rows.measured, &blur);
        smooth_levels(rows, 1.2F);
        judge_rows(rows, profile, 1.0F);
        LocalRows local;
        for (RowColumn<float>* means : {&local.misfit, &local.stray, &local.dark}) means->assign(count);
        local_means(rows, rows.measured.misfit, 2, local.misfit);
        local_means(rows, rows.stray, 2, local.stray);
        local_means(rows, rows.dark, 2, local.dark);
        UsualRows usual;
        usual.gate = true;
        usual.misfit = usual.stray = {1.5F, 4.0F};
        usual.misfits = usual.strays = {1.2F, 2.0F};
        usual.dark = {0.2F, 0.5F};
        usual.least_variance = 4e-4F;
        usual.farthest = 6.0F;
        weigh_rows(usual, local, rows);
        std::vector<float> here;
        for (const RowColumn<float>* column :
             {&rows.measured.offset, &rows.measured.information, &rows.measured.misfit,
              &rows.measured.own_outer, &rows.inner, &rows.outer, &rows.outer_variance, &rows.stray,
              &rows.dark, &rows.clean, &rows.weight, &blur.blur, &blur.digital_pull}) {
            const std::vector<float> numbers = numbers_of(*column, count);
            here.insert(here.end(), numbers.begin(), numbers.end());
        }
        expect_same(first, here);
        first = here;

        // And what they measure is what was drawn: the edge 0.3 px farther out.
        double sum = 0.0, weights = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            sum += static_cast<double>(rows.measured.information[i] * rows.measured.offset[i]);
            weights += static_cast<double>(rows.measured.information[i]);
            EXPECT_EQ(rows.measured.information[i] > 0.0F, i % 9 != 4) << i;
        }
        EXPECT_NEAR(sum / weights, 0.3, 0.05);
    });
}

TEST(RefinementVectors, TheNthSmallestIsThatOfTheSortedNumbers) {
    Random random(3);
    for (const std::size_t count : {1UL, 2UL, 16UL, 17UL, 100UL}) {
        std::vector<float> numbers(count + EdgeRows::block, -1e9F);  // what stands behind them does not count
        for (std::size_t i = 0; i < count; ++i)
            numbers[i] = static_cast<float>(i % 5 == 0 ? 0.0 : random.normal() * 10.0);
        std::vector<float> sorted(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count));
        std::sort(sorted.begin(), sorted.end());
        on_each_vector_target([&] {
            for (const std::size_t n : {std::size_t{0}, count / 3, count / 2, count - 1})
                EXPECT_EQ(nth_smallest(numbers.data(), count, n), sorted[n]) << count << " " << n;
        });
    }
}

std::vector<std::uint8_t> drawn_bytes(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<std::uint8_t> bytes(count);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.index(256));
    return bytes;
}

TEST(RefinementVectors, DifferencesOfARowArePostColours) {
    PostColour colour;
    colour.mean = {90.0F, -40.0F, 12.0F};
    colour.contrast << 0.5F, 0.1F, -0.2F, 0.1F, 0.7F, 0.05F, -0.2F, 0.05F, 0.3F;
    colour.darkest = 60.0F;
    for (const std::size_t pairs : {0UL, 1UL, 3UL, 16UL, 21UL, RowDifferences::most}) {
        // Vectors of their very length: what is read beyond them a sanitizer sees.
        const std::vector<std::uint8_t> upper = drawn_bytes(4 * pairs, 1), lower = drawn_bytes(4 * pairs, 2);
        const PairRow first(upper.data(), static_cast<int>(pairs), CameraResponse::linear);
        const PairRow second(lower.data(), static_cast<int>(pairs), CameraResponse::linear);
        on_each_vector_target([&] {
            RowDifferences differences;
            row_differences(upper.data(), lower.data(), pairs, colour, differences);
            for (std::size_t i = 0; i < pairs; ++i) {
                const auto pair = static_cast<int>(i);
                const float expected = colour.difference(0.5F * (first[pair] + second[pair]));
                EXPECT_NEAR(differences.difference[i], expected, 1e-5F * std::abs(expected) + 1e-3F)
                    << i << " of " << pairs;
            }
        });
    }
}

TEST(RefinementVectors, ABlocksPairsAreLaidOutAsTheyStandInItsRows) {
    constexpr std::size_t pairs = 7;  // no whole number of those read at once
    std::array<std::vector<std::uint8_t>, EdgeRows::block> rows;
    std::array<const std::uint8_t*, EdgeRows::block> from{};
    for (std::size_t lane = 0; lane < EdgeRows::block; ++lane) {
        rows[lane] = drawn_bytes(4 * (pairs + 1), lane + 1);
        from[lane] = rows[lane].data();
    }
    on_each_vector_target([&] {
        const auto raw = std::make_unique<RawPairs>();
        lay_out(from, pairs, raw->bins[0]);
        for (std::size_t k = 0; k < pairs; ++k)
            for (std::size_t lane = 0; lane < EdgeRows::block; ++lane)
                EXPECT_EQ(std::memcmp(&raw->bins[0][k][lane], from[lane] + 4 * k, 4), 0)
                    << k << " of row " << lane;
    });
}

TEST(RefinementVectors, EquationsOfAnEndAreItsSums) {
    Random random(11);
    const NormalTable normal;
    const EndStep step{0.4, 1.3, 2.0, 30.0};
    for (const std::size_t count : {1UL, 8UL, 61UL}) {
        RowColumn<double> way, value;
        way.assign(count);
        value.assign(count);
        EndEquations expected;
        for (std::size_t i = 0; i < count; ++i) {
            way[i] = random.uniform(-12.0, 12.0);
            value[i] = random.uniform(0.0, 35.0);
            const double z = (way[i] - step.place) / step.blur, height = step.outer - step.inner;
            const double below = 0.5 * std::erfc(-z / std::numbers::sqrt2);
            const double slope = height * std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
            const Eigen::Vector4d j(-slope / step.blur, -slope * z, 1.0 - below, below);
            const double miss = value[i] - step.inner - height * below;
            expected.information += j * j.transpose();
            expected.pull += miss * j;
            expected.squares += miss * miss;
        }
        std::optional<std::vector<double>> first;
        on_each_vector_target([&] {
            const EndEquations e = end_equations(way, value, count, step, normal);
            const double near = 1e-4 * expected.information.norm();
            EXPECT_LT((e.information - expected.information).norm(), near);
            EXPECT_LT((e.pull - expected.pull).norm(), 1e-4 * expected.pull.norm());
            EXPECT_NEAR(e.squares, expected.squares, 1e-4 * expected.squares);
            std::vector<double> here(e.information.data(), e.information.data() + 16);
            here.insert(here.end(), e.pull.data(), e.pull.data() + 4);
            here.push_back(e.squares);
            expect_same(first, here);
            first = here;
        });
    }
}

TEST(RefinementVectors, PiecesThatAgreeGiveEachOtherEvidence) {
    EdgePieceColumns pieces;
    pieces.assign(20);
    for (std::size_t i = 0; i < 20; ++i) {
        pieces.turn[i] = 10.0F * static_cast<float>(i);
        pieces.place[i] = i < 13 ? 0.02F * pieces.turn[i] : 5.0F;
        pieces.share[i] = 1.0F;
        pieces.per_square[i] = 100.0F;
    }
    on_each_vector_target([&] {
        RowColumn<float> evidence;
        evidence.assign(20);
        EXPECT_NEAR(evidence_of_places(pieces, 0.02F, evidence), 13.0F, 1e-3F);
        for (std::size_t i = 0; i < 13; ++i) EXPECT_NEAR(evidence[i], 13.0F, 1e-3F);
        for (std::size_t i = 13; i < 20; ++i) EXPECT_NEAR(evidence[i], 1.0F, 1e-3F);
    });
}

TEST(RefinementVectors, TheMostEvidenceIsThatOfAPiece) {
    EdgePieceColumns pieces;
    pieces.assign(2);
    for (std::size_t i = 0; i < 2; ++i) {
        pieces.place[i] = i == 0 ? -0.05F : 0.05F;
        pieces.share[i] = 1.0F;
        pieces.per_square[i] = 100.0F;
    }
    on_each_vector_target([&] {
        RowColumn<float> evidence;
        evidence.assign(2);
        EXPECT_NEAR(evidence_of_places(pieces, 0.0F, evidence), 1.0F, 1e-3F);  // half-way it would be 1.5
    });
}

}  // namespace
}  // namespace goalmouth::test
