#include "core/conversion/segments.h"

#include "core/messaging/typed.h"
#include "core/random/random.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Segments noise(int width, int height, int spacing, Random& random) {
    Segments segments;
    segments.width = width;
    segments.height = height;
    const auto add = [&](Orientation orientation, int position, int size) {
        ScanLine line{orientation, position, static_cast<int>(segments.segments.size()), 0};
        for (int start = 0; start < size; ++line.count) {
            const int end = std::min(size - 1, start + static_cast<int>(random.index(4)));
            const float offset = static_cast<float>(random.index(255)) / 100.F - 1.27F;
            const auto colour = static_cast<Colour>(line.count % 2 == 0 ? 1 : 4);
            segments.segments.push_back({static_cast<std::int16_t>(start), static_cast<std::int16_t>(end),
                                         colour,
                                         static_cast<float>(start) - 0.5F + (start > 0 ? offset : 0.F)});
            start = end + 1;
        }
        segments.lines.push_back(line);
    };
    for (int y = 0; y < height; y += spacing) add(Orientation::horizontal, y, width);
    for (int x = 0; x < width; x += spacing) add(Orientation::vertical, x, height);
    return segments;
}

Intrinsics camera_of(int width, int height) {
    return scaled_to(Intrinsics{}, width, height);
}

TEST(SegmentsMessage, KeepsEverythingThatFits) {
    Random random(1);
    const Segments segments = noise(160, 120, 8, random);
    const segments_t m = to_message(segments, 12, 34, camera_of(160, 120), "table");
    EXPECT_EQ(m.utime, 12);
    EXPECT_EQ(m.seq, 34);
    EXPECT_EQ(m.table, "table");
    EXPECT_EQ(m.lines_left_out, 0);
    EXPECT_EQ(problem(m), std::nullopt);
    const Segments back = from_message(m);
    EXPECT_EQ(back.width, 160);
    EXPECT_EQ(back.height, 120);
    ASSERT_EQ(back.lines.size(), segments.lines.size());
    ASSERT_EQ(back.segments.size(), segments.segments.size());
    for (std::size_t i = 0; i < back.lines.size(); ++i) {
        EXPECT_EQ(back.lines[i].orientation, segments.lines[i].orientation);
        EXPECT_EQ(back.lines[i].position, segments.lines[i].position);
        EXPECT_EQ(back.lines[i].first, segments.lines[i].first);
        EXPECT_EQ(back.lines[i].count, segments.lines[i].count);
    }
    for (std::size_t i = 0; i < back.segments.size(); ++i) {
        EXPECT_EQ(back.segments[i].start, segments.segments[i].start);
        EXPECT_EQ(back.segments[i].end, segments.segments[i].end);
        EXPECT_EQ(back.segments[i].colour, segments.segments[i].colour);
        EXPECT_NEAR(back.segments[i].transition, segments.segments[i].transition, 1e-4);
    }
}

TEST(SegmentsMessage, LeavesOutScanLinesEvenlyWhereNoiseDoesNotFit) {
    for (const int spacing : {1, 2, 4}) {
        Random random(2);
        const Segments segments = noise(640, 480, spacing, random);
        const segments_t m = to_message(segments, 0, 0, camera_of(640, 480), "t");
        EXPECT_LE(m.getEncodedSize(), 60000);
        EXPECT_GE(m.getEncodedSize(), 55000);
        EXPECT_EQ(m.lines_left_out + m.num_lines, static_cast<int>(segments.lines.size()));
        EXPECT_GT(m.lines_left_out, 0);
        EXPECT_EQ(problem(m), std::nullopt);
        int largest_step = 0;
        for (std::size_t i = 1; i < m.line_position.size(); ++i) {
            if (m.line_orientation[i] == m.line_orientation[i - 1]) {
                largest_step = std::max(largest_step, m.line_position[i] - m.line_position[i - 1]);
            }
        }
        const double kept = static_cast<double>(m.num_lines) / static_cast<double>(segments.lines.size());
        EXPECT_LE(largest_step, spacing * (1.0 / kept + 1.0));
    }
}

TEST(SegmentsMessage, OfNothingIsEmpty) {
    const segments_t m = to_message(Segments{}, 0, 0, Intrinsics{}, "");
    EXPECT_EQ(m.num_lines, 0);
    EXPECT_TRUE(from_message(m).segments.empty());
}

}  // namespace
}  // namespace goalmouth
