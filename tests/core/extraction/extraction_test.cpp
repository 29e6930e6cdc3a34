#include "core/extraction/extraction.h"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// Segments of a labelled picture on every 4th row and column; transitions lie `shift` px right of (below)
/// the pixel border.
Segments segments_of(int width, int height, const std::function<Colour(int, int)>& label, float shift = 0.F) {
    Segments segments;
    segments.width = width;
    segments.height = height;
    const auto add = [&](Orientation orientation, int position, int size) {
        ScanLine line{orientation, position, static_cast<int>(segments.segments.size()), 0};
        for (int i = 0; i < size; ++i) {
            const Colour colour =
                orientation == Orientation::horizontal ? label(i, position) : label(position, i);
            if (i == 0 || colour != segments.segments.back().colour) {
                segments.segments.push_back({static_cast<std::int16_t>(i), 0, colour,
                                             static_cast<float>(i) - 0.5F + (i > 0 ? shift : 0.F)});
                ++line.count;
            }
            segments.segments.back().end = static_cast<std::int16_t>(i);
        }
        segments.lines.push_back(line);
    };
    for (int y = 2; y < height; y += 4) add(Orientation::horizontal, y, width);
    for (int x = 2; x < width; x += 4) add(Orientation::vertical, x, height);
    return segments;
}

bool in(int v, int first, int last) {
    return v >= first && v <= last;
}

/// A field from y = 60 down, and a post at x 40…49, y 20…79.
Colour scene(int x, int y) {
    if (in(x, 40, 49) && in(y, 20, 79)) return Colour::goal;
    return y >= 60 ? Colour::field : Colour::unclassified;
}

Candidates extract(const Segments& segments, const CandidateParameters& parameters = {}) {
    return extract_candidates(segments, find_border(segments, {}), parameters);
}

TEST(Extraction, GivesBothEdgesOfAPostOnEveryRow) {
    const Candidates found = extract(segments_of(120, 100, scene, 0.25F));
    ASSERT_EQ(found.left_edges.size(), 15U);
    ASSERT_EQ(found.right_edges.size(), 15U);
    for (std::size_t i = 0; i < 15; ++i) {
        EXPECT_NEAR(found.left_edges[i].x(), 39.75, 1e-6);
        EXPECT_NEAR(found.right_edges[i].x(), 49.75, 1e-6);
        EXPECT_EQ(found.left_edges[i].y(), 22.0 + 4.0 * static_cast<double>(i));
    }
    const auto vertical = std::count_if(found.segments.begin(), found.segments.end(),
                                        [](const auto& s) { return s.orientation == Orientation::vertical; });
    EXPECT_EQ(vertical, 2);
    EXPECT_EQ(found.width, 120);
    EXPECT_EQ(found.height, 100);
}

TEST(Extraction, SaysWhereRowsShowTheField) {
    const Candidates found = extract(segments_of(120, 100, [](int x, int y) {
        if (y >= 80 && x == 60) return Colour::unclassified;          // noise: bridged
        if (y >= 80 && in(x, 90, 99)) return Colour::line;            // no noise
        if (y >= 80 && x == 119) return Colour::unclassified;         // leaves what is long enough
        if (y >= 80 && in(x, 101, 117)) return Colour::unclassified;  // and one pixel at 100, too short
        return scene(x, y);
    }));
    std::vector<std::vector<int>> at_62, at_82;
    for (const FieldRun& f : found.field) {
        EXPECT_GE(f.line, 60);
        if (f.line == 62) at_62.push_back({f.start, f.end});
        if (f.line == 82) at_82.push_back({f.start, f.end});
    }
    EXPECT_EQ(at_62, (std::vector<std::vector<int>>{{0, 39}, {50, 119}}));
    EXPECT_EQ(at_82, (std::vector<std::vector<int>>{{0, 89}}));
}

TEST(Extraction, RejectsOtherColoursAndShortAndLongSegments) {
    EXPECT_TRUE(extract(segments_of(120, 100, [](int x, int) {
                    return x < 60 ? Colour::ball : Colour::field;
                })).segments.empty());
    CandidateParameters parameters;
    parameters.shortest = 11;
    EXPECT_TRUE(extract(segments_of(120, 100, scene), parameters).left_edges.empty());
    parameters.shortest = 10;
    EXPECT_FALSE(extract(segments_of(120, 100, scene), parameters).left_edges.empty());
    parameters.longest = 9.0 / 120.0;
    EXPECT_TRUE(extract(segments_of(120, 100, scene), parameters).left_edges.empty());
}

TEST(Extraction, RejectsWhatDoesNotReachTheField) {
    const auto with_poster = [](int x, int y) {
        return in(x, 80, 99) && in(y, 10, 40) ? Colour::goal : scene(x, y);
    };
    const Segments segments = segments_of(120, 100, with_poster);
    EXPECT_EQ(extract(segments).left_edges.size(), 15U);
    CandidateParameters parameters;
    parameters.must_reach_border = false;
    EXPECT_GT(extract(segments, parameters).left_edges.size(), 15U);
}

TEST(Extraction, RejectsRegionsOfFewRows) {
    const auto with_speck = [](int x, int y) {
        return in(x, 80, 89) && in(y, 70, 84) ? Colour::goal : scene(x, y);
    };
    const Segments segments = segments_of(120, 100, with_speck);  // four rows
    EXPECT_EQ(extract(segments).left_edges.size(), 15U);
    CandidateParameters parameters;
    parameters.least_rows = 4;
    EXPECT_EQ(extract(segments, parameters).left_edges.size(), 19U);
    parameters.least_rows = 16;
    EXPECT_TRUE(extract(segments, parameters).segments.empty());
}

TEST(Extraction, KeepsACrossbarThatHangsOnAPost) {
    const auto goal = [](int x, int y) {
        return in(x, 40, 109) && in(y, 12, 19) ? Colour::goal : scene(x, y);
    };
    const Candidates found = extract(segments_of(120, 100, goal));
    EXPECT_EQ(found.left_edges.size(), 17U);
    EXPECT_TRUE(std::any_of(found.segments.begin(), found.segments.end(), [](const auto& s) {
        return s.orientation == Orientation::vertical && s.line == 90;
    }));
}

TEST(Extraction, JudgesNoPositionsWithoutAField) {
    const auto post = [](int x, int y) {
        return in(x, 40, 49) && in(y, 20, 50) ? Colour::goal : Colour::unclassified;
    };
    EXPECT_EQ(extract(segments_of(120, 100, post)).left_edges.size(), 8U);
}

TEST(Extraction, BridgesGapsAndSkippedRows) {
    const auto holed = [](int x, int y) {
        return in(x, 44, 45) || in(y, 40, 47) ? (in(x, 40, 49) && y < 80 ? Colour::unclassified : scene(x, y))
                                              : scene(x, y);
    };
    const Candidates found = extract(segments_of(120, 100, holed));
    EXPECT_EQ(found.left_edges.size(), 13U);
    for (const auto& p : found.right_edges) EXPECT_NEAR(p.x(), 49.5, 1e-6);
    CandidateParameters parameters;
    parameters.largest_gap = 1;
    EXPECT_EQ(extract(segments_of(120, 100, holed), parameters).left_edges.size(),
              13U);  // 2 px of 8: gap_share
    parameters.gap_share = 0.2;
    EXPECT_EQ(extract(segments_of(120, 100, holed), parameters).left_edges.size(), 26U);
}

TEST(Extraction, GivesNoEdgePointAtTheImageBorder) {
    const auto at_left = [](int x, int y) {
        return x < 20 ? Colour::goal : y >= 60 ? Colour::field : Colour::unclassified;
    };
    const Candidates found = extract(segments_of(120, 100, at_left));
    EXPECT_TRUE(found.left_edges.empty());
    EXPECT_EQ(found.right_edges.size(), 25U);
    const auto everywhere = [](int, int) { return Colour::goal; };
    const Candidates filled = extract(segments_of(120, 100, everywhere));
    EXPECT_TRUE(filled.left_edges.empty());
    EXPECT_TRUE(filled.right_edges.empty());
    EXPECT_EQ(filled.segments.size(), 55U);
}

TEST(Extraction, OfNothingIsNothing) {
    const Candidates found = extract_candidates({}, {}, {});
    EXPECT_TRUE(found.segments.empty());
    EXPECT_TRUE(found.left_edges.empty());
}

}  // namespace
}  // namespace goalmouth
