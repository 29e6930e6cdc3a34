// What a running graph must outlive: processes killed again and again, a neighbour of the same name, and
// shared memory without room.

#include "core/messaging/tap_url.h"
#include "core/messaging/typed.h"
#include "tests/graph/running_graph.h"
#include "tests/support/processes.h"
#include "tests/support/small_shared_memory.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <set>
#include <string>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <goalmouth/image_t.hpp>
#include <goalmouth/segments_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::RunningGraph;
using test::shipped_graph;
using test::slowly;

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
    const auto dropped = [&] {
        const auto status = graph.process("segmentation").status;
        return status ? status->dropped : -1;
    };
    ASSERT_TRUE(graph.until([&] { return dropped() >= 0; })) << graph.story();
    const std::int64_t dropped_before = dropped();
    const std::int64_t first = *seen.rbegin();
    const pid_t reader = graph.process("segmentation").pid;
    ::kill(reader, SIGSTOP);
    ASSERT_TRUE(graph.until_more("IMAGE", 20)) << graph.story();  // more than the ring holds
    ::kill(reader, SIGCONT);
    ASSERT_TRUE(graph.until_more("SEGMENTS", 5)) << graph.story();
    std::int64_t lost = 0;
    std::int64_t counted = 0;
    // This listener may miss a message, and its window begins a moment after the counter's: two frames.
    EXPECT_TRUE(graph.until([&] {
        const auto heard = std::distance(seen.find(first), seen.end());
        lost = *seen.rbegin() - first + 1 - heard;
        counted = dropped() - dropped_before;
        return lost >= 10 && std::abs(counted - lost) <= 2;
    })) << lost
        << " frames lost, " << counted << " counted\n"
        << graph.story();
    EXPECT_TRUE(graph.until_more("POSE", 3)) << graph.story();
    EXPECT_EQ(graph.process("segmentation").restarts, 0);
}

using Frames = std::set<std::pair<std::int64_t, std::int64_t>>;  // utime, seq

/// What one listener hears of a graph.
struct Overheard {
    std::set<std::string> rings;
    Frames frames;
    Frames tapped;
    Frames posts;

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
    using Start = RunningGraph::Start;
    RunningGraph one(shipped_graph("ransac"), slowly(), "udpm://239.255.76.67:7667?ttl=0", Start::later);
    RunningGraph two(shipped_graph("ransac"), slowly(), "udpm://239.255.76.67:7668?ttl=0", Start::later);
    const Overheard of_one(one);
    const Overheard of_two(two);
    one.start();
    two.start();
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
        const Overheard& other = pair == &one ? of_two : of_one;
        const auto in = [](const Frames& frames) {
            return [&frames](const auto& frame) { return frames.contains(frame); };
        };
        EXPECT_TRUE(std::none_of(own.posts.begin(), own.posts.end(), in(other.frames))) << "another's posts";
        EXPECT_TRUE(std::none_of(own.tapped.begin(), own.tapped.end(), in(other.frames)))
            << "another's picture";
        // This listener may miss a message.
        EXPECT_GE(std::count_if(own.posts.begin(), own.posts.end(), in(own.frames)) + 1,
                  std::ssize(own.posts));
        EXPECT_GE(std::count_if(own.tapped.begin(), own.tapped.end(), in(own.frames)) + 1,
                  std::ssize(own.tapped));
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

/// A file that takes all that is left of /dev/shm; its number.
int fill_shared_memory() {
    const int fd = ::open("/dev/shm/filler", O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    const std::vector<char> block(4096, 'x');
    while (::write(fd, block.data(), block.size()) > 0) {
    }
    EXPECT_EQ(errno, ENOSPC);
    return fd;
}

void go_on_while_it_is_full_and_come_back_once_there_is_room() {
    RunningGraph graph(shipped_graph("ransac"), slowly());
    ASSERT_TRUE(graph.until_more("POSE", 2)) << graph.story();
    const int filler = fill_shared_memory();

    // Nobody who runs needs more.
    ASSERT_TRUE(graph.until_more("POSE", 20)) << graph.story();
    ASSERT_TRUE(graph.until_more("IMAGE_TAP", 2)) << graph.story();
    EXPECT_EQ(counter(graph.process("camera"), "missed_frames"), 0.0);
    for (const auto& process : graph.launcher().processes()) EXPECT_EQ(process.restarts, 0) << graph.story();

    // A camera that comes anew does: what its forerunner had is still held here.
    const std::vector<std::string> rings = test::rings_of(graph.pids());
    ASSERT_EQ(rings.size(), 1U);
    const int held = ::open(("/dev/shm/" + rings.front()).c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_GE(held, 0);
    ::kill(graph.process("camera").pid, SIGKILL);
    ASSERT_TRUE(graph.until([&] { return graph.process("camera").restarts == 1; })) << graph.story();
    ASSERT_TRUE(graph.until([&] { return counter(graph.process("camera"), "missed_frames") >= 12.0; }))
        << graph.story();
    EXPECT_THAT(graph.story(), testing::HasSubstr("/dev/shm"));
    const int posts = graph.messages("POSTS");
    ASSERT_TRUE(graph.until_more("IMAGE", 5)) << graph.story();
    EXPECT_EQ(graph.messages("POSTS"), posts);

    ::close(held);  // the filler stays
    ASSERT_TRUE(graph.until_more("POSE", 5)) << graph.story();
    for (const auto& process : graph.launcher().processes()) {
        EXPECT_EQ(process.restarts, process.name == "camera" ? 1 : 0) << process.name << '\n'
                                                                      << graph.story();
    }
    ::close(filler);
}

TEST(Robustness, SharedMemoryThatFillsUpTakesNothingFromWhoRunsAndOneStartedAgainWaitsForRoom) {
    const std::string problem =
        test::with_small_shared_memory(room_for_one, go_on_while_it_is_full_and_come_back_once_there_is_room);
    if (!problem.empty()) GTEST_SKIP() << "skipped: " << problem;
}

}  // namespace
}  // namespace goalmouth
