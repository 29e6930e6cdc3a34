#include "tests/bench/graph_bench.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace goalmouth::bench {
namespace {

WayResult way(const std::string& key, double posts_us, std::int64_t lost) {
    WayResult result;
    result.key = result.title = key;
    result.seconds = 10.0;
    result.frames = 300;
    result.lost = lost;
    StageResult posts;
    posts.channel = "POSTS";
    posts.heard = posts.sent = Latency(std::vector<double>(static_cast<std::size_t>(300 - lost), posts_us));
    posts.lost = lost;
    result.stages.push_back(posts);
    ProcessResult camera;
    camera.name = "camera";
    camera.cpu = 0.25;
    result.processes.assign(2, camera);
    return result;
}

GraphBenchResult result_of(std::int64_t lost, double copies) {
    GraphBenchResult result;
    result.complete = true;
    result.width = 1600;
    result.height = 1200;
    result.frames_per_second = 30.0;
    result.ways = {way("graph", 3000.0, lost), way("one_process", 2000.0, 0)};
    result.ways[0].copies = copies;
    return result;
}

TEST(GraphBenchResult, AnswersTheRowsOfTheTable) {
    GraphBenchResult result = result_of(0, 0.0);
    result.ways[0].seconds = 300.0;
    const auto rows = result.ratios();
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].name, "frames lost, 1600x1200, 30 fps, 5 processes");
    EXPECT_EQ(rows[0].other_ms, 300.0);
    EXPECT_EQ(rows[0].ours_ms, 0.0);
    EXPECT_EQ(rows[0].seconds, 300.0);
    EXPECT_EQ(rows[0].scope, "");
    EXPECT_TRUE(rows[0].met());
    EXPECT_EQ(rows[1].name, "capture-to-posts p50, process graph ÷ one process");
    EXPECT_DOUBLE_EQ(rows[1].ours_ms, 3.0);
    EXPECT_DOUBLE_EQ(rows[1].ratio, 1.5);
    EXPECT_TRUE(rows[1].stretch_met());
    EXPECT_EQ(rows[2].name, "copies of a frame between driver and detector");
    EXPECT_TRUE(rows[2].stretch_met());
}

TEST(GraphBenchResult, NoLossAt30FramesPerSecondClaimsNothingOf60) {
    GraphBenchResult result = result_of(0, 0.0);
    EXPECT_TRUE(result.ratios()[0].met());
    EXPECT_FALSE(result.ratios()[0].stretch_met());
    result.frames_per_second = 60.0;
    EXPECT_TRUE(result.ratios()[0].stretch_met());
}

TEST(GraphBenchResult, AShorterOrSmallerRunSaysForWhatItIsMet) {
    GraphBenchResult result = result_of(0, 0.0);
    EXPECT_EQ(result.ratios()[0].scope, "for 10 s at 1600x1200");
    result.ways[0].seconds = 300.0;
    result.width = 640;
    result.height = 480;
    EXPECT_EQ(result.ratios()[0].scope, "for 300 s at 640x480");
    result.frames_per_second = 15.0;
    EXPECT_EQ(result.ratios()[0].scope, "for 300 s at 640x480, 15 fps");
}

TEST(GraphBenchResult, OneLostFrameMissesTheBar) {
    const auto rows = result_of(1, 2.0).ratios();
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_FALSE(rows[0].met());
    EXPECT_DOUBLE_EQ(rows[0].ratio, 1.0 / 300.0);
    EXPECT_FALSE(rows[2].met());
}

TEST(GraphBenchResult, RowsThatWereNotMeasuredAreThereAndNotMet) {
    GraphBenchResult result = result_of(0, -1.0);
    result.ways.resize(1);
    const auto some = result.ratios();
    ASSERT_EQ(some.size(), 3U);
    EXPECT_TRUE(some[0].met());
    for (const std::size_t i : {1U, 2U}) {
        EXPECT_FALSE(some[i].measured) << some[i].name;
        EXPECT_FALSE(some[i].met());
        EXPECT_FALSE(some[i].stretch_met());
    }
    result.ways[0].frames = 0;
    EXPECT_FALSE(result.ratios()[0].met());
    result.ways.clear();
    result.failure = "camera: died";
    const auto none = result.ratios();
    ASSERT_EQ(none.size(), 3U);
    for (const Ratio& row : none) EXPECT_FALSE(row.met()) << row.name;
    std::ostringstream out;
    result.print(out);
    EXPECT_THAT(out.str(),
                testing::AllOf(testing::HasSubstr("1600x1200"), testing::HasSubstr("camera: died")));
    EXPECT_EQ(result.to_json()["failure"], "camera: died");
}

TEST(GraphBenchResult, JsonAndTableHoldEveryWay) {
    const GraphBenchResult result = result_of(3, 0.0);
    const auto json = result.to_json();
    ASSERT_EQ(json["ways"].size(), 2U);
    EXPECT_EQ(json["ways"][0]["lost"], 3);
    EXPECT_DOUBLE_EQ(json["ways"][0]["cpu"], 0.5);
    EXPECT_EQ(json["ways"][1]["stages"][0]["heard_us"]["percentiles"].size(), 101U);
    std::ostringstream out;
    result.print(out);
    for (const char* text : {"graph", "one_process", "camera 25.0 %", "POSTS"})
        EXPECT_THAT(out.str(), testing::HasSubstr(text));
}

}  // namespace
}  // namespace goalmouth::bench
