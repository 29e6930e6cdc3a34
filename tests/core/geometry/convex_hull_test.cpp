#include "core/geometry/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The definition, in cubic time: a highest point of its column is a vertex unless some chord of the others
/// passes at or above it.
Points brute_force(const Points& points) {
    Points vertices;
    for (const auto& p : points) {
        bool beaten = false;
        for (const auto& q : points) beaten |= q.x() == p.x() && q.y() < p.y();
        for (const auto& a : points) {
            for (const auto& b : points) {
                if (a.x() < p.x() && p.x() < b.x() && cross(a, b, p) >= 0.0) beaten = true;
            }
        }
        if (!beaten) vertices.push_back(p);
    }
    std::sort(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    vertices.erase(std::unique(vertices.begin(), vertices.end(),
                               [](const auto& a, const auto& b) { return a.x() == b.x(); }),
                   vertices.end());
    return vertices;
}

TEST(UpperHull, OfNothingOnePointAndEqualPoints) {
    EXPECT_TRUE(upper_hull({}).empty());
    EXPECT_EQ(upper_hull({{3, 4}}), (Points{{3, 4}}));
    EXPECT_EQ(upper_hull({{3, 4}, {3, 4}, {3, 4}}), (Points{{3, 4}}));
}

TEST(UpperHull, OfAVerticalSetIsItsHighestPoint) {
    EXPECT_EQ(upper_hull({{3, 9}, {3, 4}, {3, 7}}), (Points{{3, 4}}));
}

TEST(UpperHull, OfALineIsItsEnds) {
    EXPECT_EQ(upper_hull({{2, 20}, {0, 0}, {1, 10}, {3, 30}}), (Points{{0, 0}, {3, 30}}));
}

TEST(UpperHull, BulgesTowardsSmallerY) {
    // A field corner points up in the image; a dent below the border is no vertex.
    EXPECT_EQ(upper_hull({{0, 100}, {50, 60}, {70, 95}, {100, 90}}), (Points{{0, 100}, {50, 60}, {100, 90}}));
    EXPECT_EQ(upper_hull({{0, 10}, {50, 60}, {100, 10}}), (Points{{0, 10}, {100, 10}}));
}

TEST(UpperHull, AgreesWithTheDefinitionOnRandomSets) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 300; ++trial) {
        const int count = 1 + trial % 25;
        std::uniform_int_distribution<int> coordinate(
            0, 3 + trial % 40);  // small ranges force ties and collinear points
        Points points;
        for (int i = 0; i < count; ++i) points.emplace_back(coordinate(random), coordinate(random));
        EXPECT_EQ(upper_hull(points), brute_force(points)) << "trial " << trial;
    }
}

TEST(UpperHull, DoesNotDependOnTheOrderOfThePoints) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> coordinate(0.0, 640.0);
    Points points;
    for (int i = 0; i < 60; ++i) points.emplace_back(coordinate(random), coordinate(random));
    const Points hull = upper_hull(points);
    for (int i = 0; i < 20; ++i) {
        std::shuffle(points.begin(), points.end(), random);
        EXPECT_EQ(upper_hull(points), hull);
    }
}

TEST(ChainYAt, IsTheEndsBeyondThemAndOfNoNumberTheFirst) {
    const Points chain{{10.0, 1.0}, {20.0, 3.0}, {30.0, 2.0}};
    EXPECT_EQ(chain_y_at(chain, 0.0), 1.0);
    EXPECT_EQ(chain_y_at(chain, 15.0), 2.0);
    EXPECT_EQ(chain_y_at(chain, 31.0), 2.0);
    EXPECT_EQ(chain_y_at(chain, std::nan("")), 1.0);
}

}  // namespace
}  // namespace goalmouth
