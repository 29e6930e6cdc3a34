// A log made by plain lcm-logger, played by plain lcm-logplayer into segmentation → localisation, gives what
// the log holds.

#include "core/messaging/lcm_bus.h"
#include "core/messaging/log_file.h"
#include "core/messaging/typed.h"
#include "tests/graph/processes.h"
#include "tests/graph/running_graph.h"
#include "tests/support/data.h"

#include <csignal>
#include <map>

#include <goalmouth/border_t.hpp>
#include <goalmouth/candidates_t.hpp>
#include <goalmouth/pose_t.hpp>
#include <goalmouth/segments_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr const char* url = "udpm://239.255.76.67:7667?ttl=0";

using Bytes = std::vector<std::uint8_t>;
/// Messages of each channel by the frame they belong to.
using Results = std::map<std::string, std::map<std::int64_t, Bytes>>;

template <class Message>
void collect_one(Results& results, const std::string& channel, std::span<const std::uint8_t> bytes) {
    Message message{};
    const auto problem = decode(bytes, message);
    ASSERT_FALSE(problem) << channel << ": " << *problem;
    results[channel][message.seq] = Bytes(bytes.begin(), bytes.end());
}

void collect(Results& results, const std::string& channel, std::span<const std::uint8_t> bytes) {
    if (channel == "SEGMENTS") collect_one<segments_t>(results, channel, bytes);
    if (channel == "BORDER") collect_one<border_t>(results, channel, bytes);
    if (channel == "CANDIDATES") collect_one<candidates_t>(results, channel, bytes);
    if (channel == "POSTS") collect_one<posts_t>(results, channel, bytes);
    if (channel == "POSE") collect_one<pose_t>(results, channel, bytes);
}

const std::vector<std::string> compared = {"SEGMENTS", "BORDER", "CANDIDATES", "POSTS", "POSE"};

TEST(Replay, GivesWhatTheLogHoldsForEveryFrame) {
    const test::TemporaryFolder folder;
    const auto log = folder.path() / "run.lcmlog";
    const std::string mark = test::new_mark();

    {
        // A machine that also compiles need not keep up with 30 frames a second.
        GraphOptions options;
        options.settings = {"camera.frames_per_second=10", "camera.frames=80"};
        test::Running logger({"lcm-logger", std::string("--lcm-url=") + url, log.string()}, mark);
        ASSERT_TRUE(test::eventually([&] { return std::filesystem::exists(log); })) << logger.output();
        test::RunningGraph graph(test::shipped_graph("record"), options);
        ASSERT_TRUE(graph.until([&] { return graph.process("camera").state == ProcessState::finished; }))
            << graph.story();
        ASSERT_TRUE(graph.until([&] { return graph.messages("POSE") >= 60; })) << graph.story();
        graph.launcher().stop();
        logger.signal(SIGINT);
        EXPECT_EQ(logger.wait(), 0);
    }
    Results recorded;
    for (const LogEvent& event : read_log(log)) collect(recorded, event.channel, event.data);
    ASSERT_GE(recorded["SEGMENTS"].size(), 60U);

    Results replayed;
    LcmBus bus(url);
    for (const auto& channel : compared) {
        bus.subscribe(channel, Delivery::every, [&replayed, channel](std::span<const std::uint8_t> bytes) {
            collect(replayed, channel, bytes);
        });
    }
    test::RunningGraph graph(test::shipped_graph("replay"));
    ASSERT_TRUE(graph.until([&] {
        for (const auto& process : graph.launcher().processes()) {
            if (!process.status) return false;
        }
        return true;
    })) << graph.story();
    test::Running player({"lcm-logplayer", std::string("--lcm-url=") + url,
                          "--regexp=(IMAGE_TAP|IMAGE_SLICES|ODOMETRY|KINEMATICS)", log.string()},
                         mark);
    const std::int64_t last = recorded["POSTS"].rbegin()->first;
    EXPECT_TRUE(graph.until(
        [&] {
            bus.dispatch(std::chrono::milliseconds(1));
            return replayed["POSTS"].contains(last);
        },
        std::chrono::seconds(60)))
        << graph.story();
    graph.until(
        [&] {
            bus.dispatch(std::chrono::milliseconds(1));
            return replayed["POSE"].size() >= recorded["POSE"].size();
        },
        std::chrono::seconds(10));

    for (const auto& channel : compared) {
        int lost = 0;
        int different = 0;
        for (const auto& [seq, bytes] : recorded[channel]) {
            const auto found = replayed[channel].find(seq);
            if (found == replayed[channel].end()) {
                ++lost;
            } else if (found->second != bytes) {
                ++different;
            }
        }
        EXPECT_EQ(lost, 0) << channel << ": of " << recorded[channel].size() << " frames";
        EXPECT_EQ(different, 0) << channel << ": of " << recorded[channel].size() << " frames";
    }
}

}  // namespace
}  // namespace goalmouth
