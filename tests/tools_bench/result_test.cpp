#include "core/detection/line_search.h"
#include "core/detection/ransac_parameters.h"
#include "core/random/random.h"
#include "tests/bench/frames.h"
#include "tests/bench/point_sets.h"
#include "tests/bench/stages.h"
#include "tests/bench/summary.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace goalmouth::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

StageRow row(const std::string& name, double median) {
    StageRow result;
    result.timing = timing_of(name, "label of " + name, {median});
    return result;
}

PointRow points(std::size_t count, double ours_ms, double literal_ms) {
    PointRow result;
    result.points = count;
    result.ours = timing_of("ours", "", {ours_ms});
    result.literal = timing_of("literal", "", {literal_ms});
    result.same_consensus = true;
    return result;
}

SizeResult size_result(ImageSize size, double factor) {
    SizeResult result;
    result.size = size;
    result.frames = 120;
    for (const int spacing : spacings) {
        const std::string end = "_" + std::to_string(spacing);
        result.rows.push_back(row("segments" + end, factor * 8.0 / spacing));
        result.rows.push_back(row("edge_segments" + end, factor * 10.0 / spacing));
        result.rows.push_back(row("frame_to_posts" + end, factor * 12.0 / spacing));
        result.rows.push_back(row("naive_segments" + end, factor * 32.0 / spacing));
    }
    result.rows.push_back(row("read", factor * 0.5));
    result.rows.push_back(row("hsv", factor * 6.0));
    result.rows.push_back(row("canny_hough", factor * 12.0));
    result.rows.push_back(row("lsd", factor * 60.0));
    return result;
}

StagesResult stages_result() {
    StagesResult result;
    result.sizes = {size_result({640, 480}, 0.125), size_result({1600, 1200}, 1.0)};
    result.points = {points(50, 0.002, 0.02), points(100, 0.002, 0.04), points(200, 0.003, 0.06),
                     points(500, 0.01, 0.2), points(1000, 0.3, 0.4)};
    result.complete = true;
    return result;
}

TEST(Ratio, IsOursOverTheOtherAndIsMetUpToTheBar) {
    const Ratio ratio = time_ratio("name", 0.5, "other", 2.0, 0.25, 0.2);
    EXPECT_DOUBLE_EQ(ratio.ratio, 0.25);
    EXPECT_TRUE(ratio.met());
    EXPECT_FALSE(ratio.stretch_met());
    EXPECT_FALSE(time_ratio("name", 0.51, "other", 2.0, 0.25, 0.2).met());
    EXPECT_TRUE(time_ratio("name", 0.4, "other", 2.0, 0.25, 0.2).stretch_met());
}

TEST(StageRatios, AreThoseOfTheAcceptanceTableAtTheLargestSizeAndTheJudgedSpacing) {
    const auto ratios = stage_ratios(stages_result());
    std::vector<std::string> names;
    std::vector<double> values;
    std::vector<double> bars;
    std::vector<double> stretches;
    for (const Ratio& ratio : ratios) {
        names.push_back(ratio.name);
        values.push_back(ratio.ratio);
        bars.push_back(ratio.bar);
        stretches.push_back(ratio.stretch);
    }
    EXPECT_THAT(
        names,
        ElementsAre("scan + segments ÷ our naive version", "scan + segments ÷ one read of the frame",
                    "RANSAC ÷ literal, 50–500 points, same consensus",
                    "frame → posts ÷ HSV + inRange + findContours", "frame → posts ÷ Canny + HoughLinesP",
                    "frame → posts ÷ LSD", "segments by edges ÷ scan + segments"));
    EXPECT_THAT(values, ElementsAre(0.25, 2.0, 0.1, 0.25, 0.125, 0.025, 1.25));
    EXPECT_THAT(bars, ElementsAre(0.33, 3.5, 0.10, 0.30, 0.12, 0.025, 1.5));
    EXPECT_THAT(stretches, ElementsAre(0.25, 2.5, 0.05, 0.20, 0.08, 0.015, 1.0));
    EXPECT_DOUBLE_EQ(ratios[0].ours_ms, 1.0);
    EXPECT_DOUBLE_EQ(ratios[0].other_ms, 4.0);
}

TEST(StageRatios, OfRansacIsTheWorstUpTo500Points) {
    StagesResult result = stages_result();
    result.points[2] = points(200, 0.03, 0.06);
    const Ratio ratio = stage_ratios(result).at(2);
    EXPECT_DOUBLE_EQ(ratio.ratio, 0.5);
    EXPECT_DOUBLE_EQ(ratio.ours_ms, 0.03);
    EXPECT_THAT(ratio.other, HasSubstr("200 points"));
}

TEST(StageRatios, EndWithRefinementsWhereItWasTried) {
    StagesResult result = stages_result();
    RefinementRow& row = result.sizes[1].refinement.emplace();
    row.posts = 40;
    row.refined = 38;
    row.ours = timing_of("ours", "", {0.25});
    row.full = timing_of("full", "", {5.0});
    const auto ratios = stage_ratios(result);
    ASSERT_EQ(ratios.size(), 9U);
    const Ratio& time = ratios[7];
    EXPECT_EQ(time.name, "refinement, ms a post");
    EXPECT_DOUBLE_EQ(time.ratio, 0.25);
    EXPECT_DOUBLE_EQ(time.bar, 0.3);
    EXPECT_TRUE(time.met());
    EXPECT_THAT(time.note, HasSubstr("40 posts, 38 refined"));
    const Ratio& share = ratios[8];
    EXPECT_EQ(share.name, "refinement ÷ full least squares");
    EXPECT_DOUBLE_EQ(share.ratio, 0.05);
    EXPECT_DOUBLE_EQ(share.bar, 0.10);
    EXPECT_EQ(share.size, "1600x1200");
    row = {};
    EXPECT_FALSE(stage_ratios(result)[7].met());
    EXPECT_FALSE(stage_ratios(result)[8].measured);
}

TEST(StageRatios, AreNotGivenForAnInterruptedRun) {
    StagesResult result = stages_result();
    result.complete = false;
    EXPECT_TRUE(stage_ratios(result).empty());
}

TEST(StagesResult, IsUnsoundWhereAFastVersionDisagreesWithItsPlainOne) {
    StagesResult result = stages_result();
    EXPECT_TRUE(result.sound());
    result.points[4].same_consensus = false;
    EXPECT_FALSE(result.sound());
    result = stages_result();
    result.same_segments = false;
    EXPECT_FALSE(result.sound());
}

TEST(StageRatios, SayWhereTheyAreOfAnotherSizeOrOfFewFrames) {
    StagesResult result = stages_result();
    EXPECT_EQ(stage_ratios(result)[0].scope, "");
    result.sizes[1].frames = 119;
    EXPECT_EQ(stage_ratios(result)[0].scope, "with fewer than 120 frames: not cold");
    result.sizes.resize(1);
    EXPECT_EQ(stage_ratios(result)[0].scope, "at 640x480");
    EXPECT_EQ(stage_ratios(result)[0].spacing, 8);
}

TEST(RatiosText, NamesRowsThatWereNotMeasured) {
    Ratio row = time_ratio("row", 0.0, "other", 1.0, 0.2, 0.1);
    row.measured = false;
    EXPECT_FALSE(row.met());
    EXPECT_THAT(ratios_text({row}), HasSubstr("not measured\n"));
    BenchResult result;
    result.graph.emplace();
    const auto json = bench_json(result);
    ASSERT_EQ(json["ratios"].size(), 3U);
    for (const auto& each : json["ratios"]) {
        EXPECT_TRUE(each["ratio"].is_null());
        EXPECT_EQ(each["met"], false);
    }
}

TEST(RatiosText, SaysWhatIsMet) {
    const std::string text = ratios_text({time_ratio("good", 1.0, "other", 10.0, 0.2, 0.15),
                                          time_ratio("fair", 1.0, "other", 10.0, 0.1, 0.05),
                                          time_ratio("bad", 1.0, "other", 10.0, 0.05, 0.01)});
    EXPECT_THAT(text, HasSubstr("met, stretch too\n"));
    EXPECT_THAT(text, HasSubstr("met\n"));
    EXPECT_THAT(text, HasSubstr("NOT MET\n"));
}

/// 20 px wide, upright, 100 px high.
ReferencePost post() {
    return {{100.0, 50.0}, {100.0, 150.0}, {120.0, 50.0}, {120.0, 150.0}, true};
}

std::pair<std::size_t, std::size_t> seen_of_asked(const ReferencePost& post,
                                                  const std::vector<SeenEdge>& edges) {
    std::size_t seen = 0;
    std::size_t asked = 0;
    count_seen_edges({post}, edges, seen, asked);
    return {seen, asked};
}

TEST(SeenEdges, AnEdgeIsSeenWithinAQuarterOfTheWidth) {
    using Pair = std::pair<std::size_t, std::size_t>;
    EXPECT_EQ(seen_of_asked(post(), {}), Pair(0, 2));
    EXPECT_EQ(seen_of_asked(post(), {{{104.9, 50.0}, {104.9, 150.0}}}), Pair(1, 2));
    EXPECT_EQ(seen_of_asked(post(), {{{105.1, 50.0}, {105.1, 150.0}}}), Pair(0, 2));
    EXPECT_EQ(seen_of_asked(post(), {{{100.0, 150.0}, {100.0, 50.0}}, {{118.0, 50.0}, {122.0, 150.0}}}),
              Pair(2, 2));
}

TEST(SeenEdges, PiecesCountTogetherAndOneOfThreeHeightsIsTooLittle) {
    using Pair = std::pair<std::size_t, std::size_t>;
    EXPECT_EQ(seen_of_asked(post(), {{{100.0, 70.0}, {100.0, 80.0}}}), Pair(0, 2));
    EXPECT_EQ(seen_of_asked(post(), {{{100.0, 70.0}, {100.0, 80.0}}, {{101.0, 95.0}, {101.0, 105.0}}}),
              Pair(1, 2));
}

TEST(SeenEdges, PostsThatDoNotCountAreNotAskedFor) {
    ReferencePost hidden = post();
    hidden.counts = false;
    EXPECT_EQ(seen_of_asked(hidden, {}).second, 0U);
}

TEST(FramesBeyondCache, FillTwiceTheCacheAndAreNeverFewerThan120) {
    EXPECT_EQ(frames_beyond_cache({1600, 1200}, 0), 120);
    EXPECT_EQ(frames_beyond_cache({1600, 1200}, 32U << 20), 120);
    const int frames = frames_beyond_cache({640, 480}, 105U << 20);
    EXPECT_GE(frames * 640UL * 480UL * 2UL, 2UL * (105UL << 20));
    EXPECT_LT((frames - 1) * 640UL * 480UL * 2UL, 2UL * (105UL << 20));
}

TEST(EdgePointSet, HasAsManyPointsAsAskedForAndFollowsFromTheSeed) {
    for (const std::size_t count : point_counts) EXPECT_EQ(edge_point_set(count, 7).size(), count);
    EXPECT_EQ(edge_point_set(50, 7), edge_point_set(50, 7));
    EXPECT_NE(edge_point_set(50, 7), edge_point_set(50, 8));
}

TEST(EdgePointSet, HoldsTwoEdgesThatRansacFinds) {
    Random random(1);
    const auto lines = find_lines(edge_point_set(200, 3), RansacParameters{}, random);
    ASSERT_GE(lines.size(), 2U);
    EXPECT_GE(lines[0].support, 80);
    EXPECT_GE(lines[1].support, 45);
}

TEST(SameLines, DiffersWithAnySupportAndAnyBit) {
    Random random(1);
    const auto lines = find_lines(edge_point_set(100, 3), RansacParameters{}, random);
    ASSERT_FALSE(lines.empty());
    EXPECT_TRUE(same_lines(lines, lines));
    auto other = lines;
    ++other[0].support;
    EXPECT_FALSE(same_lines(lines, other));
    other = lines;
    other[0].segment.upper.x() += 1e-9;
    EXPECT_FALSE(same_lines(lines, other));
    other.pop_back();
    EXPECT_FALSE(same_lines(lines, other));
}

}  // namespace
}  // namespace goalmouth::bench
