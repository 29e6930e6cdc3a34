#include "core/geometry/line.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using Points = std::vector<Eigen::Vector2d>;

TEST(Line, ThroughTwoPointsContainsBoth) {
    const auto line = line_through({3.0, 4.0}, {10.0, -20.0});
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->distance({3.0, 4.0}), 0.0, 1e-12);
    EXPECT_NEAR(line->distance({10.0, -20.0}), 0.0, 1e-12);
    EXPECT_NEAR(line->normal.norm(), 1.0, 1e-15);
}

TEST(Line, ThroughEqualPointsDoesNotExist) {
    EXPECT_FALSE(line_through({3.0, 4.0}, {3.0, 4.0}));
}

TEST(Line, SignedDistanceIsPositiveToTheRightWhicheverWayThePointsCome) {
    for (const auto& line :
         {line_through({5.0, 0.0}, {7.0, 100.0}), line_through({7.0, 100.0}, {5.0, 0.0})}) {
        ASSERT_TRUE(line);
        EXPECT_GT(line->signed_distance({50.0, 50.0}), 0.0);
        EXPECT_GT(line->direction().y(), 0.0);
    }
}

TEST(Line, FitRecoversAVerticalLine) {
    const auto line = fit_line(Points{{7.0, 0.0}, {7.0, 10.0}, {7.0, 3.0}});
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->x_at(1e6).value(), 7.0, 1e-6);
    EXPECT_NEAR(line->normal.x(), 1.0, 1e-12);
}

TEST(Line, FitRecoversAHorizontalLine) {
    const auto line = fit_line(Points{{0.0, 5.0}, {10.0, 5.0}, {3.0, 5.0}});
    ASSERT_TRUE(line);
    EXPECT_FALSE(line->x_at(5.0));
    EXPECT_NEAR(line->signed_distance({100.0, 8.0}), 3.0, 1e-12);
}

TEST(Line, FitNeedsTwoDifferentPoints) {
    EXPECT_FALSE(fit_line(Points{}));
    EXPECT_FALSE(fit_line(Points{{1.0, 2.0}}));
    EXPECT_FALSE(fit_line(Points{{319.7, 211.3}, {319.7, 211.3}, {319.7, 211.3}}));
    EXPECT_TRUE(fit_line(Points{{1.0, 2.0}, {1.0, 2.5}}));
}

TEST(Line, FitOfASquareHasNoDirection) {
    EXPECT_FALSE(fit_line(Points{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}));
}

TEST(Line, FitLeavesTheLeastSumOfSquares) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 2.0);
    for (int trial = 0; trial < 50; ++trial) {
        const double angle = trial * std::numbers::pi / 50.0;
        const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
        Points points;
        for (int i = 0; i < 40; ++i)
            points.push_back(Eigen::Vector2d(300, 200) + 5.0 * i * along +
                             Eigen::Vector2d(noise(random), noise(random)));
        const auto cost = [&](const Line& line) {
            double sum = 0.0;
            for (const auto& p : points) sum += std::pow(line.distance(p), 2);
            return sum;
        };
        const auto fit = fit_line(points);
        ASSERT_TRUE(fit);
        const double best = cost(*fit);
        for (const double turn : {-0.01, 0.0, 0.01}) {
            for (const double shift : {-0.2, 0.0, 0.2}) {
                if (turn == 0.0 && shift == 0.0) continue;
                Line other = *fit;
                const Eigen::Vector2d mean = fit->foot(points[20]);
                other = line_with_normal(Eigen::Rotation2Dd(turn) * fit->normal, mean + shift * fit->normal);
                EXPECT_GT(cost(other), best);
            }
        }
    }
}

TEST(Line, FitFollowsEveryDirection) {
    for (int degrees = 0; degrees < 180; ++degrees) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
        for (int count = 2; count < 12; ++count) {
            Points points;
            for (int i = 0; i < count; ++i) points.push_back(Eigen::Vector2d(30, 20) + (3.0 + i * i) * along);
            const auto fit = fit_line(points);
            ASSERT_TRUE(fit) << degrees;
            EXPECT_NEAR(fit->normal.dot(along), 0.0, 1e-13) << degrees;
            EXPECT_NEAR(fit->normal.norm(), 1.0, 1e-15) << degrees;
            for (const auto& p : points) EXPECT_NEAR(fit->signed_distance(p), 0.0, 1e-11) << degrees;
        }
    }
}

TEST(Line, RmsDistanceIsTheRootOfTheMeanSquare) {
    const auto line = line_through({0.0, 3.0}, {1.0, 3.0});
    Points points;
    double squares = 0.0;
    for (int count = 1; count < 12; ++count) {
        points.emplace_back(7.0 * count, 3.0 + count);
        squares += count * count;
        EXPECT_NEAR(rms_distance(*line, points), std::sqrt(squares / count), 1e-12);
    }
}

TEST(Line, FitDoesNotDependOnTheOrderOfThePoints) {
    Points points{{1.0, 2.0}, {5.0, 9.0}, {3.0, 6.5}, {9.0, 17.0}, {-4.0, -8.0}};
    const auto first = fit_line(points);
    std::mt19937 random(1);
    for (int i = 0; i < 20; ++i) {
        std::shuffle(points.begin(), points.end(), random);
        const auto again = fit_line(points);
        ASSERT_TRUE(again);
        EXPECT_NEAR((again->normal - first->normal).norm(), 0.0, 1e-12);
        EXPECT_NEAR(again->offset, first->offset, 1e-9);
    }
}

TEST(Line, AcuteAngleIgnoresSenseAndStaysBelowAQuarterTurn) {
    const auto upright = line_through({0.0, 0.0}, {0.0, 1.0});
    for (int degrees = 0; degrees < 360; degrees += 7) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const auto turned = line_through({0.0, 0.0}, {std::sin(angle), std::cos(angle)});
        const double expected = std::asin(std::abs(std::sin(angle)));
        EXPECT_NEAR(acute_angle(*upright, *turned), expected, 1e-9) << degrees;
        EXPECT_NEAR(acute_angle(*turned, *upright), expected, 1e-9) << degrees;
    }
}

TEST(LineSegment, EndsAtTheFeetOfTheExtremePoints) {
    const auto line = line_through({10.0, 0.0}, {10.0, 1.0});
    const LineSegment segment = segment_on_line(*line, Points{{12.0, 30.0}, {9.0, -5.0}, {10.0, 7.0}});
    EXPECT_NEAR((segment.upper - Eigen::Vector2d(10.0, -5.0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((segment.lower - Eigen::Vector2d(10.0, 30.0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(segment.length(), 35.0, 1e-12);
}

TEST(LineSegment, OfAHorizontalLineRunsFromLeftToRight) {
    const auto line = line_through({0.0, 3.0}, {1.0, 3.0});
    const LineSegment segment = segment_on_line(*line, Points{{12.0, 3.0}, {-5.0, 3.0}});
    EXPECT_NEAR(segment.upper.x(), -5.0, 1e-12);
    EXPECT_NEAR(segment.lower.x(), 12.0, 1e-12);
}

TEST(PointColumns, GiveTheDigitsThatPointsGive) {
    std::mt19937 generator(11);
    std::normal_distribution<double> noise(0.0, 20.0);
    for (int n = 1; n < 40; ++n) {
        Points points;
        std::vector<double> x;
        std::vector<double> y;
        for (int i = 0; i < n; ++i) {
            points.emplace_back(300.0 + noise(generator), 7.0 * i + noise(generator));
            x.push_back(points.back().x());
            y.push_back(points.back().y());
        }
        const PointColumns columns{x, y};
        const auto line = fit_line(points);
        const auto again = fit_line(columns);
        ASSERT_EQ(line.has_value(), again.has_value()) << n;
        if (!line) continue;
        ASSERT_EQ(line->normal, again->normal) << n;
        ASSERT_EQ(line->offset, again->offset) << n;
        ASSERT_EQ(rms_distance(*line, points), rms_distance(*again, columns)) << n;
        const LineSegment segment = segment_on_line(*line, points);
        const LineSegment segment_again = segment_on_line(*again, columns);
        ASSERT_EQ(segment.upper, segment_again.upper) << n;
        ASSERT_EQ(segment.lower, segment_again.lower) << n;
    }
}

TEST(Intersection, LiesOnBothLinesAndIsMissingForParallels) {
    const auto a = line_through({0.0, 0.0}, {10.0, 10.0});
    const auto b = line_through({0.0, 8.0}, {10.0, -2.0});
    const auto p = intersection(*a, *b);
    ASSERT_TRUE(p);
    EXPECT_NEAR((*p - Eigen::Vector2d(4.0, 4.0)).norm(), 0.0, 1e-12);
    EXPECT_FALSE(intersection(*a, *line_through({1.0, 0.0}, {11.0, 10.0})));
}

}  // namespace
}  // namespace goalmouth
