// The graphs that ship, with the real processes.

#include "core/messaging/typed.h"
#include "tests/graph/garbage.h"
#include "tests/graph/processes.h"
#include "tests/graph/running_graph.h"

#include <csignal>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::RunningGraph;
using test::shipped_graph;
using test::slowly;

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

INSTANTIATE_TEST_SUITE_P(Detectors, ShippedGraph, testing::Values("refined", "ransac", "histogram"),
                         [](const auto& graph) { return std::string(graph.param); });

TEST(RunningGraphTest, EveryPostsMessageIsRefinedOnce) {
    RunningGraph graph(shipped_graph("refined"), slowly(), {}, RunningGraph::Start::later);
    std::map<std::int64_t, posts_t> found;
    std::map<std::int64_t, posts_t> refined;
    int answers = 0;
    int measured = 0;
    subscribe<posts_t>(graph.bus(), "POSTS", [&](const posts_t& m) { found[m.seq] = m; });
    subscribe<posts_t>(graph.bus(), "POSTS_REFINED", [&](const posts_t& m) {
        refined[m.seq] = m;
        ++answers;
        for (const post_t& post : m.posts) measured += (post.flags & post_t::REFINED) != 0 ? 1 : 0;
    });
    graph.start();
    EXPECT_TRUE(graph.until([&] { return refined.size() >= 30 && measured >= 10; })) << graph.story();
    graph.launcher().stop();
    EXPECT_EQ(static_cast<std::size_t>(answers), refined.size());
    int compared = 0;
    for (const auto& [seq, posts] : refined) {
        const auto original = found.find(seq);
        if (original == found.end()) continue;  // lost on its way to this listener
        ++compared;
        EXPECT_EQ(posts.utime, original->second.utime);
        EXPECT_EQ(posts.num_posts, original->second.num_posts);
        EXPECT_EQ(posts.detector, original->second.detector + " refined");
    }
    EXPECT_GT(compared, 20);
    EXPECT_EQ(graph.process("refinement").restarts, 0);
}

class KilledProcess : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(KilledProcess, ComesBackAndTheGraphLives) {
    const auto [victim, channel] = GetParam();
    RunningGraph graph(shipped_graph("refined"), slowly());
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
                                         std::pair{"detection", "POSTS"},
                                         std::pair{"refinement", "POSTS_REFINED"},
                                         std::pair{"localisation", "POSE"}, std::pair{"tap", "IMAGE_TAP"}),
                         [](const auto& killed) { return std::string(killed.param.first); });

TEST(RunningGraphTest, GarbageOnThePortIsCountedAndSkipped) {
    RunningGraph graph(shipped_graph("refined"), slowly());
    ASSERT_TRUE(graph.until_more("POSE", 3)) << graph.story();
    test::send_garbage({"IMAGE", "SEGMENTS", "CANDIDATES", "POSTS", "POSTS_REFINED", "ODOMETRY", "KINEMATICS",
                        "STATUS", "NOBODYS"},
                       20);
    for (const char* name : {"segmentation", "extraction", "detection", "refinement", "localisation"}) {
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
