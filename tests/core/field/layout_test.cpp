#include "core/field/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(Field, PostsStandOnTheGoalLinesAGoalWidthApart) {
    const Field field;
    const auto posts = field.posts();
    EXPECT_EQ(posts[0], Eigen::Vector2d(-3.0, 0.75));
    EXPECT_EQ(posts[1], Eigen::Vector2d(-3.0, -0.75));
    EXPECT_EQ(posts[2], Eigen::Vector2d(3.0, 0.75));
    EXPECT_EQ(posts[3], Eigen::Vector2d(3.0, -0.75));
}

TEST(Layout, PaintsWhatTheRulesSay) {
    const FieldLayout kidsize = layout(Field{});
    for (const auto& [x, y, painted] : {std::tuple{3.0, 0.0, true},      // goal line
                                        std::tuple{-3.0, 1.9, true},     // goal line
                                        std::tuple{0.0, 1.0, true},      // halfway line
                                        std::tuple{1.5, 2.0, true},      // side line
                                        std::tuple{1.5, -2.0, true},     // side line
                                        std::tuple{0.6, 0.0, true},      // centre circle
                                        std::tuple{2.4, 0.3, true},      // goal area's front
                                        std::tuple{-2.7, -1.1, true},    // goal area's side
                                        std::tuple{1.2, 0.0, true},      // penalty mark
                                        std::tuple{-1.2, 0.04, true},    // penalty mark's other stroke
                                        std::tuple{-1.2, 0.06, false},   // just beyond it
                                        std::tuple{1.5, 1.5, false},     // carpet
                                        std::tuple{0.3, 0.0, false},     // inside the circle
                                        std::tuple{2.4, 1.2, false},     // beyond the goal area
                                        std::tuple{3.2, 0.0, false}}) {  // behind the goal line
        EXPECT_EQ(on_line(kidsize, {x, y}), painted) << x << ", " << y;
    }
    EXPECT_DOUBLE_EQ(kidsize.carpet_half_length, 3.7);
    EXPECT_DOUBLE_EQ(kidsize.carpet_half_width, 2.7);
}

TEST(Layout, LinesAreAsWideAsStated) {
    Field field;
    field.line_width = 0.12;
    const FieldLayout wide = layout(field);
    EXPECT_TRUE(on_line(wide, {1.5, 2.0 + 0.0599}));
    EXPECT_FALSE(on_line(wide, {1.5, 2.0 + 0.0601}));
    EXPECT_TRUE(on_line(wide, {0.6 * std::cos(0.7) * 1.0999, 0.6 * std::sin(0.7) * 1.0999}));
    EXPECT_FALSE(on_line(wide, {0.6 * std::cos(0.7) * 1.1001, 0.6 * std::sin(0.7) * 1.1001}));
}

TEST(Layout, CornersAreFull) {
    const Field field;
    const FieldLayout lines = layout(field);
    const double outer = field.line_width / 2.0 - 1e-6;
    for (const double sx : {-1.0, 1.0})
        for (const double sy : {-1.0, 1.0}) {
            EXPECT_TRUE(on_line(lines, {sx * (3.0 + outer), sy * (2.0 + outer)}));
            EXPECT_TRUE(on_line(lines, {sx * (2.4 - outer), sy * (1.1 + outer)}));
        }
}

TEST(Layout, IsSymmetric) {
    Field field;
    field.length = 9.0;
    field.width = 6.0;
    const FieldLayout lines = layout(field);
    for (double x = 0.0; x < 5.0; x += 0.0371)
        for (double y = 0.0; y < 3.3; y += 0.0413) {
            const bool painted = on_line(lines, {x, y});
            ASSERT_EQ(painted, on_line(lines, {-x, y})) << x << ", " << y;
            ASSERT_EQ(painted, on_line(lines, {x, -y})) << x << ", " << y;
        }
}

TEST(Layout, LeavesOutPartsOfSizeZero) {
    Field field;
    field.goal_area_depth = 0.0;
    field.circle_diameter = 0.0;
    field.mark_size = 0.0;
    const FieldLayout bare = layout(field);
    EXPECT_TRUE(bare.rings.empty());
    EXPECT_EQ(bare.strokes.size(), 5U);
}

TEST(Layout, DistanceToPaintIsEuclidean) {
    const Stroke stroke{{0.0, 0.0}, {2.0, 0.0}, 0.1};
    EXPECT_DOUBLE_EQ(distance_to(stroke, {1.0, 0.04}), 0.0);
    EXPECT_DOUBLE_EQ(distance_to(stroke, {1.0, -0.25}), 0.2);
    EXPECT_DOUBLE_EQ(distance_to(stroke, {2.4, 0.0}), 0.4);
    EXPECT_NEAR(distance_to(stroke, {2.3, 0.45}), 0.5, 1e-12);
    const Ring ring{{1.0, 1.0}, 0.5, 0.1};
    EXPECT_NEAR(distance_to(ring, {1.0, 1.0}), 0.45, 1e-12);
    EXPECT_NEAR(distance_to(ring, {1.0, 2.0}), 0.45, 1e-12);
    EXPECT_DOUBLE_EQ(distance_to(ring, {1.5, 1.0}), 0.0);
}

}  // namespace
}  // namespace goalmouth
