// What a running graph must outlive: processes killed again and again, a neighbour of the same name, and
// shared memory without room.

#include "core/messaging/tap_url.h"
#include "core/messaging/typed.h"
#include "tests/graph/processes.h"
#include "tests/graph/running_graph.h"
#include "tests/support/small_shared_memory.h"

#include <algorithm>
#include <csignal>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <goalmouth/image_t.hpp>
#include <goalmouth/segments_t.hpp>
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

double counter(const ProcessReport& process, const std::string& name) {
    if (!process.status) return 0.0;
    for (const auto& c : process.status->counters) {
        if (c.name == name) return c.value;
    }
    return 0.0;
}

TEST(Robustness, KilledAgainAndAgainFramesReachThePoseAndNoRingStays) {
    RunningGraph graph(shipped_graph("ransac"), slowly());
    std::map<std::string, int> kills;
    for (const std::string victim :
         {"camera", "segmentation", "camera", "tap", "localisation", "camera", "extraction", "camera"}) {
        ASSERT_TRUE(graph.until_more("POSE", 2)) << graph.story();
        ::kill(graph.process(victim).pid, SIGKILL);
        ++kills[victim];
        ASSERT_TRUE(graph.until([&] {
            return graph.process(victim).restarts == kills[victim] && graph.process(victim).pid != 0;
        })) << graph.story();
        ASSERT_TRUE(graph.until_more("IMAGE", 1)) << victim << '\n' << graph.story();
        std::set<pid_t> dead = graph.pids();
        dead.erase(graph.process("camera").pid);
        EXPECT_THAT(test::rings_of(dead), testing::IsEmpty()) << "after the death of " << victim;
    }
    ASSERT_TRUE(graph.until_more("POSE", 5)) << graph.story();
    ASSERT_TRUE(graph.until_more("IMAGE_TAP", 2)) << graph.story();
    for (const auto& process : graph.launcher().processes()) {
        EXPECT_EQ(process.restarts, kills[process.name]) << process.name << '\n' << graph.story();
    }
    graph.launcher().stop();
    EXPECT_THAT(test::rings_of(graph.pids()), testing::IsEmpty());
}

TEST(Robustness, AReaderThatFellBehindCountsEachFrameItLost) {
    RunningGraph graph(shipped_graph("ransac"), slowly());
    std::set<std::int64_t> seen;
    subscribe<segments_t>(graph.bus(), "SEGMENTS", [&](const segments_t& m) { seen.insert(m.seq); });
    ASSERT_TRUE(graph.until_more("POSE", 2)) << graph.story();
    const pid_t reader = graph.process("segmentation").pid;
    ::kill(reader, SIGSTOP);
    ASSERT_TRUE(graph.until_more("IMAGE", 20)) << graph.story();  // more than the ring holds
    ::kill(reader, SIGCONT);
    ASSERT_TRUE(graph.until_more("SEGMENTS", 5)) << graph.story();
    std::int64_t lost = 0;
    std::int64_t counted = 0;
    EXPECT_TRUE(graph.until([&] {
        lost = *seen.rbegin() - *seen.begin() + 1 - static_cast<std::int64_t>(seen.size());
        const auto status = graph.process("segmentation").status;
        counted = status ? status->dropped : 0;
        return lost >= 10 && counted == lost;
    })) << lost
        << " frames lost, " << counted << " counted\n"
        << graph.story();
    EXPECT_TRUE(graph.until_more("POSE", 3)) << graph.story();
    EXPECT_EQ(graph.process("segmentation").restarts, 0);
}

/// What one listener hears of a graph.
struct Overheard {
    std::set<std::string> rings;
    std::set<std::pair<std::int64_t, std::int64_t>> frames;  // utime, seq
    std::set<std::pair<std::int64_t, std::int64_t>> tapped;
    std::set<std::pair<std::int64_t, std::int64_t>> posts;

    explicit Overheard(RunningGraph& graph) {
        subscribe<image_t>(graph.bus(), "IMAGE", [this](const image_t& m) {
            rings.insert(m.ring);
            frames.insert({m.utime, m.seq});
        });
        subscribe<posts_t>(graph.bus(), "POSTS", [this](const posts_t& m) {
            posts.insert({m.utime, m.seq});
        });
        subscribe<image_t>(graph.tap_bus(), "IMAGE_TAP", [this](const image_t& m) {
            tapped.insert({m.utime, m.seq});
        });
    }
};

TEST(Robustness, TwoRobotsOnNeighbouringPortsDoNotMeet) {
    RunningGraph one(shipped_graph("ransac"), slowly(), "udpm://239.255.76.67:7667?ttl=0");
    RunningGraph two(shipped_graph("ransac"), slowly(), "udpm://239.255.76.67:7668?ttl=0");
    const Overheard of_one(one);
    const Overheard of_two(two);
    ASSERT_TRUE(test::eventually(
        [&] {
            one.step();
            two.step();
            return std::min({of_one.posts.size(), of_two.posts.size(), 3 * of_one.tapped.size(),
                             3 * of_two.tapped.size()}) >= 15;
        },
        std::chrono::seconds(60)))
        << one.story() << two.story();
    for (auto* pair : {&one, &two}) {
        const Overheard& own = pair == &one ? of_one : of_two;
        const std::string camera = "-" + std::to_string(pair->process("camera").pid) + "-";
        ASSERT_EQ(own.rings.size(), 1U);
        EXPECT_NE(own.rings.begin()->find(camera), std::string::npos) << *own.rings.begin();
        for (const auto& frame : own.posts)
            EXPECT_TRUE(own.frames.contains(frame)) << "posts of no own frame";
        for (const auto& frame : own.tapped) EXPECT_TRUE(own.frames.contains(frame)) << "another's picture";
        for (const auto& process : pair->launcher().processes()) EXPECT_EQ(process.restarts, 0);
    }
}

constexpr int too_small = 1;     // [MB] for any ring
constexpr int room_for_one = 7;  // the ring of a 640×480 camera has 5 MB

void start_without_room_and_go_on_once_there_is() {
    RunningGraph graph(shipped_graph("ransac"), slowly());
    ASSERT_TRUE(graph.until([&] { return counter(graph.process("camera"), "missed_frames") >= 3.0; }))
        << graph.story();
    EXPECT_THAT(graph.story(), testing::HasSubstr("/dev/shm"));
    EXPECT_EQ(graph.messages("POSTS"), 0);

    test::resize_shared_memory(room_for_one);
    ASSERT_TRUE(graph.until_more("POSE", 3)) << graph.story();

    // The memory of a camera that died comes free for the next.
    ::kill(graph.process("camera").pid, SIGKILL);
    ASSERT_TRUE(graph.until([&] { return graph.process("camera").restarts == 1; })) << graph.story();
    ASSERT_TRUE(graph.until_more("POSE", 3)) << graph.story();
    for (const auto& process : graph.launcher().processes()) {
        EXPECT_EQ(process.restarts, process.name == "camera" ? 1 : 0) << graph.story();
    }
}

TEST(Robustness, WithoutRoomInSharedMemoryTheGraphKeepsTryingAndGoesOnOnceThereIs) {
    const std::string problem =
        test::with_small_shared_memory(too_small, start_without_room_and_go_on_once_there_is);
    if (!problem.empty()) GTEST_SKIP() << "skipped: " << problem;
}

}  // namespace
}  // namespace goalmouth
