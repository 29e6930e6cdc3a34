#include "core/detection/line_search.h"

#include "core/detection/line_inliers.h"
#include "core/detection/line_scoring.h"
#include "tests/reference/literal_ransac.h"
#include "tests/support/vector_targets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using Points = std::vector<Eigen::Vector2d>;

std::uint64_t bits(double value) {
    return std::bit_cast<std::uint64_t>(value);
}

/// To the last bit.
::testing::AssertionResult same(const std::vector<EdgeLine>& found, const std::vector<EdgeLine>& expected) {
    if (found.size() != expected.size())
        return ::testing::AssertionFailure() << found.size() << " lines, not " << expected.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto numbers = [](const EdgeLine& line) {
            const LineSegment& s = line.segment;
            return std::array{bits(s.line.normal.x()), bits(s.line.normal.y()), bits(s.line.offset),
                              bits(s.upper.x()),       bits(s.upper.y()),       bits(s.lower.x()),
                              bits(s.lower.y()),       bits(line.rms)};
        };
        if (found[i].support != expected[i].support)
            return ::testing::AssertionFailure()
                   << "line " << i << " has " << found[i].support << " points, not " << expected[i].support;
        if (numbers(found[i]) != numbers(expected[i]))
            return ::testing::AssertionFailure() << "line " << i << " is another one";
    }
    return ::testing::AssertionSuccess();
}

/// Points of every kind that could go wrong.
Points random_points(Random& random) {
    constexpr int sizes[] = {0, 1, 2, 3, 6, 7, 20, 60, 150, 400, 1001};
    const auto count = random.index(static_cast<std::uint32_t>(sizes[random.index(11)]) + 1);
    const double scale = std::pow(10.0, random.index(4) == 0 ? random.uniform(-40, 18) : 3.0);
    const double shift = random.index(6) == 0 ? scale * std::pow(10.0, random.uniform(0, 12)) : 0.0;
    const std::uint32_t kind = random.index(6);
    const double noise = scale * std::pow(10.0, random.uniform(-8, -1));
    Points points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = random.uniform(0, scale);
        const double y = random.uniform(0, scale);
        switch (kind) {
            case 0:  // anywhere
                points.emplace_back(x, y);
                break;
            case 1:  // two lines among others
                if (i % 3 == 0)
                    points.emplace_back(x, y);
                else
                    points.emplace_back(0.3 * scale * (i % 3) + 0.1 * y + noise * random.normal(), y);
                break;
            case 2:  // few places
                points.emplace_back(std::floor(4 * x / scale) * scale, std::floor(3 * y / scale) * scale);
                break;
            case 3:  // one line without noise
                points.emplace_back(x, 0.5 * x);
                break;
            case 4:  // one place
                points.emplace_back(0.25 * scale, 0.75 * scale);
                break;
            default:  // as from pictures: whole rows, single precision along them
                points.emplace_back(static_cast<float>(i % 2 ? 0.4 * scale + noise * random.normal() : x),
                                    std::floor(y));
        }
        points.back().array() += shift;
    }
    return points;
}

RansacParameters random_parameters(Random& random, const Points& points) {
    RansacParameters p;
    p.attempts = static_cast<int>(1 + random.index(random.index(8) == 0 ? 300 : 70));
    p.minimum_points = static_cast<int>(2 + random.index(8));
    p.maximum_models = static_cast<int>(1 + random.index(5));
    p.inlier_distance = std::pow(10.0, random.uniform(-2, 1.5));
    if (points.size() >= 2 && random.index(3) == 0) {
        // Exactly as far as some point: on the edge of the decision.
        const auto any = [&] { return points[random.index(static_cast<std::uint32_t>(points.size()))]; };
        const auto line = line_through(any(), any());
        const double distance = line ? line->distance(any()) : 0.0;
        if (distance > 0.0 && std::isfinite(distance)) p.inlier_distance = distance;
    }
    if (random.index(4) == 0) p.confidence = random.uniform(0.5, 1.0);
    return p;
}

TEST(LineSearch, IsTheLiteralAlgorithmBitForBit) {
    test::on_each_vector_target([] {
        for (std::uint64_t seed = 0; seed < 2000; ++seed) {
            Random random(seed);
            const Points points = random_points(random);
            const RansacParameters parameters = random_parameters(random, points);
            Random ours(seed + 1);
            Random literal(seed + 1);
            const auto expected = find_lines_literally(points, parameters, literal);
            LineSearch search(parameters);
            ASSERT_TRUE(same(search.find(points, ours), expected)) << "seed " << seed;
            ASSERT_EQ(ours.bits(), literal.bits()) << "seed " << seed;
        }
    });
}

TEST(LineSearch, ForgetsTheLastSet) {
    LineSearch search({});
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Points points = random_points(random);
        Random ours(seed);
        Random literal(seed);
        ASSERT_TRUE(same(search.find(points, ours), find_lines_literally(points, {}, literal)))
            << "seed " << seed;
    }
}

TEST(LineSearch, WithLessConfidenceFindsALineOfPointsThatAllAgree) {
    Points points;
    for (int i = 0; i < 80; ++i) points.emplace_back(100.0 + 0.2 * i, 5.0 * i);
    RansacParameters parameters;
    parameters.attempts = 100000;
    parameters.confidence = 0.99;
    Random random(3);
    const auto lines = find_lines(points, parameters, random);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].support, 80);
}

TEST(LineSearch, NeedsTheAttemptsOfTheTextbook) {
    RansacParameters parameters;
    parameters.attempts = 1000;
    EXPECT_EQ(attempts_needed(parameters, 50, 100, 2), 1000U);
    parameters.confidence = 0.99;
    EXPECT_EQ(attempts_needed(parameters, 50, 100, 2), 17U);  // Fischler and Bolles: log 0.01 / log 0.75
    EXPECT_EQ(attempts_needed(parameters, 100, 100, 2), 1U);
    EXPECT_EQ(attempts_needed(parameters, 1, 100, 2), 1000U);
    EXPECT_EQ(attempts_needed(parameters, 0, 100, 2), 1000U);
}

/// Points as the search has them.
struct Table {
    explicit Table(const Points& points)
        : x(points.size() + room_behind_points),
          y(x.size()),
          on_grid(x.size()),
          box(split_points(points, x.data(), y.data())) {}

    std::vector<double> x, y;
    std::vector<GridPoint> on_grid;
    Box box;
};

/// The bound of each sample's support and the support.
void expect_bounds(const Points& points, double distance, Random& random) {
    Table table(points);
    const Grid grid = grid_for(table.box, distance);
    if (grid.scale == 0.0) return;
    place_on_grid(grid, table.x.data(), table.y.data(), points.size(), table.on_grid.data());
    const auto count = static_cast<std::uint32_t>(points.size());
    LineSamples samples;
    std::vector<std::optional<Line>> lines;
    const std::size_t drawn = 1 + random.index(LineSamples::most);
    for (; samples.count < drawn; ++samples.count) {
        const std::uint32_t a = random.index(count);
        const std::uint32_t b = random.index(count);
        samples.first[samples.count] = table.on_grid[a];
        samples.second[samples.count] = table.on_grid[b];
        lines.push_back(line_through(points[a], points[b]));
    }
    std::array<std::uint32_t, LineSamples::most> support;
    std::vector<GridPoint> rounded(table.x.size());
    const SupportBounds bounds = bound_support(samples, grid.near, table.on_grid.data(), points.size(),
                                               rounded.data(), support.data());
    const auto most = std::max_element(support.begin(), support.begin() + static_cast<std::ptrdiff_t>(drawn));
    ASSERT_EQ(bounds.most, *most);
    ASSERT_EQ(bounds.first, static_cast<std::size_t>(most - support.begin()));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!lines[i]) continue;
        const auto inliers = std::count_if(points.begin(), points.end(),
                                           [&](const auto& p) { return lines[i]->distance(p) < distance; });
        ASSERT_LE(static_cast<std::uint32_t>(inliers), support[i]);
        ASSERT_EQ(count_inliers(table.x.data(), table.y.data(), points.size(), *lines[i], distance),
                  static_cast<std::size_t>(inliers));
    }
}

TEST(LineScoring, NeverBoundsTheSupportTooLow) {
    test::on_each_vector_target([] {
        for (std::uint64_t seed = 0; seed < 1000; ++seed) {
            Random random(seed);
            const Points points = random_points(random);
            if (!points.empty()) expect_bounds(points, std::pow(10.0, random.uniform(-3, 2)), random);
        }
    });
}

TEST(LineScoring, CountsMorePointsThanSixteenBits) {
    test::on_each_vector_target([] {
        Random random(5);
        Points points;
        for (int i = 0; i < 70000; ++i)
            points.emplace_back(random.uniform(0, 1600), 300.0 + 0.1 * random.normal());
        expect_bounds(points, 5.0, random);
    });
}

TEST(LineScoring, BoundsASampleAloneAsAmongOthers) {
    // Few samples are counted in another way than many.
    test::on_each_vector_target([] {
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            Random random(seed);
            const std::uint32_t count = 1 + random.index(100);
            Points points;
            for (std::uint32_t i = 0; i < count; ++i)
                points.emplace_back(random.uniform(0, 300), random.uniform(0, 200));
            Table table(points);
            const Grid grid = grid_for(table.box, 5.0);
            if (grid.scale == 0.0) continue;
            place_on_grid(grid, table.x.data(), table.y.data(), count, table.on_grid.data());
            std::vector<GridPoint> rounded(table.x.size());
            const auto bound = [&](const LineSamples& samples) {
                std::array<std::uint32_t, LineSamples::most> support;
                bound_support(samples, grid.near, table.on_grid.data(), count, rounded.data(),
                              support.data());
                return support;
            };
            LineSamples all;
            all.count = LineSamples::most;
            for (std::size_t i = 0; i < all.count; ++i) {
                all.first[i] = table.on_grid[random.index(count)];
                all.second[i] = table.on_grid[random.index(count)];
            }
            const auto expected = bound(all);
            for (std::size_t i = 0; i < all.count; ++i) {
                LineSamples alone;
                alone.count = 1;
                alone.first[0] = all.first[i];
                alone.second[0] = all.second[i];
                ASSERT_EQ(bound(alone)[0], expected[i]) << "sample " << i << " of seed " << seed;
            }
            for (all.count = 1; all.count < LineSamples::most; ++all.count) {
                const auto found = bound(all);
                for (std::size_t i = 0; i < all.count; ++i)
                    ASSERT_EQ(found[i], expected[i]) << "sample " << i << " of " << all.count;
            }
        }
    });
}

TEST(LineScoring, IsSureOfAllButAFewPerCentInPictures) {
    // Otherwise hypothesis after hypothesis would be counted twice.
    const auto reach = [](const Box& box) {
        const Grid grid = grid_for(box, 5.0);
        return grid.near / grid.scale;
    };
    EXPECT_LT(reach({{0, 0}, {640, 480}}), 5.2);
    EXPECT_LT(reach({{0, 0}, {1600, 1200}}), 5.5);
    EXPECT_LT(reach({{1e6, 1e6}, {1001600, 1001200}}), 5.5);
    EXPECT_EQ(grid_for({{0, 0}, {1e200, 1e200}}, 5.0).scale, 0.0);
}

TEST(LineScoring, PutsABoxAroundThePoints) {
    test::on_each_vector_target([] {
        Random random(8);
        for (std::uint32_t count = 1; count < 60; ++count) {
            Points points;
            for (std::uint32_t i = 0; i < count; ++i)
                points.emplace_back(random.uniform(-50, 50), random.uniform(-50, 50));
            const Table table(points);
            Box box{points[0], points[0]};
            for (std::size_t i = 0; i < points.size(); ++i) {
                ASSERT_EQ(Eigen::Vector2d(table.x[i], table.y[i]), points[i]);
                box.least = box.least.cwiseMin(points[i]);
                box.greatest = box.greatest.cwiseMax(points[i]);
            }
            ASSERT_EQ(table.box.least, box.least);
            ASSERT_EQ(table.box.greatest, box.greatest);
        }
    });
}

TEST(LineScoring, TakesTheInliersAndKeepsTheOrderOfBoth) {
    test::on_each_vector_target([] {
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            Random random(seed);
            Points points;
            for (std::uint32_t i = random.index(100); i > 0; --i)
                points.emplace_back(random.uniform(0, 20), random.uniform(0, 20));
            const Line line = line_with_normal({1.0, random.uniform(-1, 1)}, {10, 10});
            Points near;
            Points far;
            for (const auto& p : points) (line.distance(p) < 4.0 ? near : far).push_back(p);
            Table table(points);
            for (std::size_t i = 0; i < points.size(); ++i)
                table.on_grid[i] = {static_cast<std::int32_t>(1000 * points[i].x()), 7};
            std::vector<double> x(table.x.size());
            std::vector<double> y(table.y.size());
            const std::size_t taken = take_inliers({table.x.data(), table.y.data(), table.on_grid.data()},
                                                   points.size(), line, 4.0, x.data(), y.data());
            ASSERT_EQ(taken, near.size());
            for (std::size_t i = 0; i < near.size(); ++i) ASSERT_EQ(Eigen::Vector2d(x[i], y[i]), near[i]);
            for (std::size_t i = 0; i < far.size(); ++i) {
                ASSERT_EQ(Eigen::Vector2d(table.x[i], table.y[i]), far[i]);
                ASSERT_EQ(table.on_grid[i].x, static_cast<std::int32_t>(1000 * far[i].x()));
                ASSERT_EQ(table.on_grid[i].y, 7);
            }
        }
    });
}

}  // namespace
}  // namespace goalmouth
