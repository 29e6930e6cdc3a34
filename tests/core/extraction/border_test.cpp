#include "core/extraction/border.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// A column of the image as runs of (colour, length) from the top.
void add_column(Segments& segments, int x, const std::vector<std::pair<Colour, int>>& runs) {
    ScanLine line{Orientation::vertical, x, static_cast<int>(segments.segments.size()), 0};
    int y = 0;
    for (const auto& [colour, length] : runs) {
        segments.segments.push_back({static_cast<std::int16_t>(y), static_cast<std::int16_t>(y + length - 1),
                                     colour, static_cast<float>(y) - 0.5F});
        y += length;
        ++line.count;
    }
    segments.lines.push_back(line);
}

TEST(Border, IsTheHullOfTheFirstLongGreenRuns) {
    Segments segments;
    segments.width = 100;
    segments.height = 100;
    add_column(segments, 10, {{Colour::unclassified, 50}, {Colour::field, 50}});
    add_column(segments, 30, {{Colour::unclassified, 20}, {Colour::field, 80}});
    add_column(segments, 50, {{Colour::unclassified, 60}, {Colour::field, 40}});
    add_column(segments, 70, {{Colour::unclassified, 30}, {Colour::field, 70}});
    const FieldBorder border = find_border(segments, {});
    EXPECT_EQ(border.points.size(), 4U);
    const std::vector<Eigen::Vector2d> hull{{10, 50}, {30, 20}, {70, 30}};
    EXPECT_EQ(border.hull, hull);
    EXPECT_DOUBLE_EQ(border.y_at(20), 35.0);
    EXPECT_DOUBLE_EQ(border.y_at(50), 25.0);
    EXPECT_DOUBLE_EQ(border.y_at(0), 50.0);
    EXPECT_DOUBLE_EQ(border.y_at(99), 30.0);
}

TEST(Border, NeedsARunOfTheThreshold) {
    Segments segments;
    segments.width = segments.height = 100;
    add_column(segments, 10,
               {{Colour::unclassified, 10},
                {Colour::field, 4},
                {Colour::unclassified, 6},
                {Colour::field, 5},
                {Colour::line, 75}});
    EXPECT_EQ(find_border(segments, {5}).points.front(), Eigen::Vector2d(10, 20));
    EXPECT_EQ(find_border(segments, {4}).points.front(), Eigen::Vector2d(10, 10));
    EXPECT_TRUE(find_border(segments, {6}).empty());
}

TEST(Border, OfNoFieldIsEmptyAndHorizontalLinesDoNotCount) {
    Segments segments;
    segments.width = segments.height = 100;
    EXPECT_TRUE(find_border(segments, {}).empty());
    add_column(segments, 10, {{Colour::field, 100}});
    segments.lines.back().orientation = Orientation::horizontal;
    EXPECT_TRUE(find_border(segments, {}).empty());
}

}  // namespace
}  // namespace goalmouth
