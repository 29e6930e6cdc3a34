#include "core/edges/line_writer.h"

#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

struct Stretch {
    int start, end;
    Colour colour;
    bool operator==(const Stretch&) const = default;
};

std::vector<Stretch> runs_of(const Segments& segments) {
    std::vector<Stretch> runs;
    for (const Segment& s : segments.segments) runs.push_back({s.start, s.end, s.colour});
    return runs;
}

TEST(LineWriter, CutsALineWhereItsColourChanges) {
    Segments segments;
    LineWriter line(segments, Orientation::horizontal, 7);
    line.change(0, Colour::unclassified);
    line.change(10, Colour::goal, 9.3F);
    line.change(20, Colour::goal);  // no change
    line.change(30, Colour::field, 35.F);
    line.end(40);
    EXPECT_EQ(runs_of(segments),
              (std::vector<Stretch>{
                  {0, 9, Colour::unclassified}, {10, 29, Colour::goal}, {30, 39, Colour::field}}));
    EXPECT_FLOAT_EQ(segments.segments[1].transition, 9.3F);
    EXPECT_FLOAT_EQ(segments.segments[2].transition, 30.77F) << "as far as a segments_t reaches";
    ASSERT_EQ(segments.lines.size(), 1U);
    EXPECT_EQ(segments.lines[0].position, 7);
    EXPECT_EQ(segments.lines[0].count, 3);
}

TEST(LineWriter, MakesOneOfNeighboursThatTurnOutOfOneColour) {
    Segments segments;
    LineWriter line(segments, Orientation::horizontal, 0);
    line.change(0, Colour::unclassified);
    line.change(10, Colour::goal);
    line.change(20, Colour::field);
    line.change(20, Colour::goal);  // the next post begins where this one ends
    line.change(30, Colour::field);
    line.end(40);
    EXPECT_EQ(runs_of(segments),
              (std::vector<Stretch>{
                  {0, 9, Colour::unclassified}, {10, 29, Colour::goal}, {30, 39, Colour::field}}));
    EXPECT_EQ(segments.lines[0].count, 3);

    LineWriter below(segments, Orientation::horizontal, 1);
    below.change(0, Colour::field);
    below.change(0, Colour::goal);
    below.end(40);
    EXPECT_EQ(segments.lines[1].first, 3);
    EXPECT_EQ(segments.lines[1].count, 1);
    EXPECT_EQ(segments.segments[3].colour, Colour::goal) << "the line before is another one";
}

}  // namespace
}  // namespace goalmouth
