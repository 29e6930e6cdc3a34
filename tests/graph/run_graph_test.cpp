// The graphs that ship, with the real processes.

#include "tests/graph/garbage.h"
#include "tests/graph/processes.h"
#include "tests/graph/running_graph.h"

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::RunningGraph;
using test::shipped_graph;

/// A machine that also compiles need not keep up with 30 frames a second.
GraphOptions slowly() {
    GraphOptions options;
    options.settings = {"camera.frames_per_second=10", "tap.every=2"};
    return options;
}

class ShippedGraph : public testing::TestWithParam<const char*> {};

TEST_P(ShippedGraph, FindsPostsAndItself) {
    RunningGraph graph(shipped_graph(GetParam()), slowly());
    int with_posts = 0;
    std::int64_t last = -1;
    EXPECT_TRUE(graph.until([&] {
        if (graph.posts().seq != last && graph.posts().num_posts > 0) ++with_posts;
        last = graph.posts().seq;
        return with_posts >= 10 && graph.messages("POSE") >= 10 && graph.messages("TRUTH") >= 10;
    })) << graph.story();
    for (const auto& process : graph.launcher().processes()) {
        EXPECT_EQ(process.restarts, 0) << process.name << '\n' << graph.story();
    }
    EXPECT_TRUE(graph.until([&] { return graph.process("localisation").status.has_value(); }));
    graph.launcher().stop();
    for (const pid_t pid : graph.pids()) EXPECT_FALSE(pid > 0 && test::process_lives(pid));
    EXPECT_THAT(test::rings_of(graph.pids()), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Detectors, ShippedGraph, testing::Values("ransac", "histogram"),
                         [](const auto& graph) { return std::string(graph.param); });

class KilledProcess : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(KilledProcess, ComesBackAndTheGraphLives) {
    const auto [victim, channel] = GetParam();
    RunningGraph graph(shipped_graph("ransac"), slowly());
    ASSERT_TRUE(graph.until_more(channel, 2)) << graph.story();
    ASSERT_TRUE(graph.until_more("POSE", 2)) << graph.story();
    const pid_t first = graph.process(victim).pid;
    ::kill(first, SIGKILL);
    EXPECT_TRUE(graph.until([&, name = victim] {
        return graph.process(name).restarts == 1 && graph.process(name).pid != 0;
    })) << graph.story();
    EXPECT_TRUE(graph.until([&, name = victim] { return graph.process(name).status.has_value(); }))
        << graph.story();
    for (const char* flows : {channel, "POSTS", "POSE"})
        EXPECT_TRUE(graph.until_more(flows, 3)) << flows << graph.story();
    for (const auto& process : graph.launcher().processes()) {
        EXPECT_EQ(process.restarts, process.name == victim ? 1 : 0) << process.name << '\n' << graph.story();
    }
    graph.launcher().stop();
    EXPECT_THAT(test::rings_of(graph.pids()), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(EachInTurn, KilledProcess,
                         testing::Values(std::pair{"camera", "IMAGE"}, std::pair{"segmentation", "SEGMENTS"},
                                         std::pair{"extraction", "CANDIDATES"},
                                         std::pair{"detection", "POSTS"}, std::pair{"localisation", "POSE"},
                                         std::pair{"tap", "IMAGE_TAP"}),
                         [](const auto& killed) { return std::string(killed.param.first); });

TEST(RunningGraphTest, GarbageOnThePortIsCountedAndSkipped) {
    RunningGraph graph(shipped_graph("ransac"), slowly());
    ASSERT_TRUE(graph.until_more("POSE", 3)) << graph.story();
    test::send_garbage(
        {"IMAGE", "SEGMENTS", "CANDIDATES", "POSTS", "ODOMETRY", "KINEMATICS", "STATUS", "NOBODYS"}, 20);
    for (const char* name : {"segmentation", "extraction", "detection", "localisation"}) {
        EXPECT_TRUE(graph.until([&] {
            const auto status = graph.process(name).status;
            return status && status->rejected > 0;
        })) << name
            << " counts nothing\n"
            << graph.story();
    }
    EXPECT_TRUE(graph.until_more("POSTS", 10)) << graph.story();
    EXPECT_TRUE(graph.until_more("POSE", 10)) << graph.story();
    for (const auto& process : graph.launcher().processes()) EXPECT_EQ(process.restarts, 0) << graph.story();
}

TEST(RunningGraphTest, ADetectorInJavaReplacesOurs) {
    RunningGraph graph(std::string(GOALMOUTH_SOURCE_DIR) + "/tests/graph/java.yaml", slowly());
    EXPECT_TRUE(graph.until([&] {
        return graph.posts().detector == "java_detector" && graph.posts().num_posts > 0;
    })) << graph.story();
    EXPECT_TRUE(graph.until([&] { return graph.pose().posts_used > 0; })) << graph.story();
    EXPECT_TRUE(graph.until([&] { return graph.process("detection").status.has_value(); })) << graph.story();
    EXPECT_EQ(graph.process("detection").status->rejected, 0);
}

}  // namespace
}  // namespace goalmouth
