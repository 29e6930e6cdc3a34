// The benchmark itself, for a moment: what it says must hang together, however fast the machine is.

#include "tests/bench/graph_bench.h"

#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/network.h"
#include "tests/support/post_scene.h"

#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth::bench {
namespace {

class GraphBench : public testing::Test {
  protected:
    void SetUp() override {
        GOALMOUTH_NEEDS_PRIVATE_NETWORK();
        test::PostScene scene;
        scene.width = options_.width = 640;
        scene.height = options_.height = 480;
        for (const int shift : {0, 40, 80}) {
            scene.post_left += shift;
            scene.post_right += shift;
            write_yuyv(folder_.path() / ("00" + std::to_string(shift / 40) + ".yuyv"),
                       test::scene_image(scene).view());
        }
        options_.seconds = 2.0;
        options_.frames_folder = folder_.path();
        options_.programs_folder = std::filesystem::path(GOALMOUTH_BINARY_DIR) / "bin";
    }

    static void expect_sound(const WayResult& way) {
        SCOPED_TRACE(way.key);
        EXPECT_GT(way.frames, 0);
        EXPECT_GE(way.seconds, 2.0);
        ASSERT_EQ(way.stages.size(), 5U);
        std::int64_t most_lost = 0;
        for (const StageResult& stage : way.stages) {
            SCOPED_TRACE(stage.channel);
            EXPECT_EQ(static_cast<std::int64_t>(stage.heard.ages.size()) + stage.lost, way.frames);
            EXPECT_EQ(stage.sent.ages.size(), stage.heard.ages.size());
            EXPECT_LE(stage.heard.p50(), stage.heard.p99());
            EXPECT_LE(stage.heard.p99(), stage.heard.max());
            most_lost = std::max(most_lost, stage.lost);
        }
        EXPECT_GE(way.lost, std::max(way.stage("POSTS")->lost, way.stage("POSE")->lost));
        EXPECT_LE(way.lost, way.frames);
        EXPECT_GT(way.cpu(), 0.0);
    }

    test::TemporaryFolder folder_;
    GraphBenchOptions options_;
};

TEST_F(GraphBench, EveryWayIsMeasuredAndAddsUp) {
    double last = 0.0;
    const auto result = run_graph_bench(options_, [&](const std::string& what, double done, double wanted) {
        EXPECT_FALSE(what.empty());
        EXPECT_GE(done, last);
        EXPECT_LE(done, wanted);
        last = done;
    });
    EXPECT_TRUE(result.complete);
    ASSERT_EQ(result.ways.size(), 4U);
    for (const WayResult& way : result.ways) expect_sound(way);

    const WayResult* graph = result.way("graph");
    ASSERT_NE(graph, nullptr);
    ASSERT_EQ(graph->processes.size(), 5U);
    for (const ProcessResult& process : graph->processes) EXPECT_GT(process.cpu, 0.0) << process.name;
    const WayResult* alone = result.way("one_process");
    ASSERT_NE(alone, nullptr);
    EXPECT_EQ(alone->lost, 0);
    for (const WayResult* way : {graph, alone}) {
        for (const StageResult& stage : way->stages) {
            ASSERT_FALSE(stage.heard.ages.empty()) << way->key << stage.channel;
            EXPECT_GT(stage.heard.ages.front(), 0.0) << way->key << stage.channel;
        }
        EXPECT_LT(way->stage("SEGMENTS")->heard.p50(), way->stage("POSTS")->heard.p50());
        EXPECT_LT(way->stage("POSTS")->heard.p50(), way->stage("POSE")->heard.p50());
    }
    EXPECT_EQ(result.way("messages")->processes.front().name, "sender");
    EXPECT_GE(result.way("messages_large_buffer")->receive_buffer, result.way("messages")->receive_buffer);
    for (const WayResult* way : {graph, alone}) {
        EXPECT_EQ(way->copies, 0.0) << way->key;
        EXPECT_GE(way->lines_left_out, 0.0) << way->key;
    }
    EXPECT_GE(static_cast<double>(alone->frames),
              std::floor(options_.seconds * options_.frames_per_second) - 2.0);
    EXPECT_EQ(alone->not_sent, 0);
    for (const char* key : {"messages", "messages_large_buffer"}) {
        const WayResult* way = result.way(key);
        EXPECT_THAT(way->title, testing::HasSubstr(std::to_string(way->receive_buffer) + " bytes"));
    }

    const auto rows = result.ratios();
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].name, "frames lost, 640x480, 30 fps, 5 processes");
    EXPECT_EQ(rows[0].other_ms, static_cast<double>(graph->frames));
    EXPECT_EQ(rows[1].name, "capture-to-posts p50, process graph ÷ one process");
    EXPECT_GT(rows[1].ratio, 0.0);
    EXPECT_EQ(rows[2].name, "copies of a frame between driver and detector");
    for (const Ratio& row : rows) EXPECT_TRUE(row.measured) << row.name;
}

TEST_F(GraphBench, EndsWhenAsked) {
    int asked = 0;
    options_.stop = [&] { return ++asked > 3; };
    options_.seconds = 600.0;
    const auto result = run_graph_bench(options_, {});
    EXPECT_FALSE(result.complete);
    EXPECT_THAT(result.ways, testing::IsEmpty());
    for (const Ratio& row : result.ratios()) EXPECT_FALSE(row.met()) << row.name;
}

TEST_F(GraphBench, ProgramsThatAreNotThereAreTheUsersToMend) {
    options_.programs_folder = folder_.path();
    EXPECT_THROW(check_graph_bench(options_), ConfigurationError);
    EXPECT_THROW(run_graph_bench(options_, {}), ConfigurationError);
}

}  // namespace
}  // namespace goalmouth::bench
