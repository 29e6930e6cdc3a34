// A log made by plain lcm-logger on the tap's port, or by the tap itself, played by plain lcm-logplayer into
// segmentation → localisation, gives what the log holds.

#include "core/messaging/lcm_bus.h"
#include "core/messaging/log_file.h"
#include "core/messaging/typed.h"
#include "tests/graph/running_graph.h"
#include "tests/support/data.h"
#include "tests/support/processes.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iostream>
#include <map>

#include <goalmouth/border_t.hpp>
#include <goalmouth/candidates_t.hpp>
#include <goalmouth/pose_t.hpp>
#include <goalmouth/refinement_t.hpp>
#include <goalmouth/segments_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr const char* url = "udpm://239.255.76.67:7667?ttl=0";
constexpr const char* url_of_tap = "udpm://239.255.76.67:8667?ttl=0";

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
    if (channel == "REFINEMENT") collect_one<refinement_t>(results, channel, bytes);
    if (channel == "POSTS_REFINED") collect_one<posts_t>(results, channel, bytes);
    if (channel == "POSE") collect_one<pose_t>(results, channel, bytes);
}

const std::vector<std::string> compared = {"SEGMENTS", "BORDER",        "CANDIDATES",
                                           "POSTS",    "POSTS_REFINED", "POSE"};

/// A machine that also compiles need not keep up with 30 frames a second.
GraphOptions slowly(int frames) {
    GraphOptions options;
    options.settings = {"camera.frames_per_second=10", "camera.frames=" + std::to_string(frames)};
    return options;
}

void run_until_poses(test::RunningGraph& graph, int poses) {
    ASSERT_TRUE(graph.until([&] { return graph.process("camera").state == ProcessState::finished; }))
        << graph.story();
    ASSERT_TRUE(graph.until([&] { return graph.messages("POSE") >= poses; })) << graph.story();
    graph.launcher().stop();
}

/// Runs the recording graph beside lcm-logger on the tap's port. The stages of that graph work on shared
/// memory: on their own port there are no pixels.
void record_with_logger(const std::filesystem::path& log, const std::string& mark) {
    std::filesystem::remove(log);  // one of an earlier run would end the wait before the logger listens
    test::Running logger({"lcm-logger", "--force", std::string("--lcm-url=") + url_of_tap, log.string()},
                         mark);
    ASSERT_TRUE(test::eventually([&] { return std::filesystem::exists(log); })) << logger.output();
    test::RunningGraph graph(test::shipped_graph("record"), slowly(80));
    run_until_poses(graph, 60);
    logger.signal(SIGINT);
    EXPECT_EQ(logger.wait(), 0);
}

/// Runs the recording graph with a tap that writes the log itself and sends nothing.
void record_with_tap(const std::filesystem::path& log, const std::string&) {
    std::filesystem::remove(log);
    GraphOptions options = slowly(30);
    options.settings.insert(options.settings.end(), {"tap.url=off", "tap.file=" + log.string()});
    test::RunningGraph graph(test::shipped_graph("record"), options);
    run_until_poses(graph, 20);
}

/// The simulator's camera with 1600×1200 pixels.
std::filesystem::path two_megapixels(const std::filesystem::path& folder) {
    const auto file = folder / "two_megapixels.yaml";
    std::ofstream(file) << "width: 1600\nheight: 1200\nfx: 1385.65\nfy: 1385.65\ncx: 799.5\ncy: 599.5\n"
                           "k1: 0\nk2: 0\np1: 0\np2: 0\nk3: 0\n";
    return file;
}

/// Five frames a second of two megapixels. The log begins with the first frame: waiting is ten times as long
/// when it is played.
void record_two_megapixels(const std::filesystem::path& log, const std::string&) {
    std::filesystem::remove(log);
    GraphOptions options;
    options.settings = {
        "camera.camera=" + two_megapixels(log.parent_path()).string(),
        "camera.frames_per_second=5",
        "camera.frames=6",
        "tap.url=off",
        "tap.file=" + log.string(),
        "tap.forward_channels=(SEGMENTS|BORDER|CANDIDATES|POSTS|POSTS_REFINED|POSE|ODOMETRY|KINEMATICS)"};
    test::RunningGraph graph(test::shipped_graph("record"), options);
    run_until_poses(graph, 3);
}

/// Plays the log into the replaying graph; what came out of it up to the frame `last`.
Results replay(const std::filesystem::path& log, std::int64_t last, const std::string& mark,
               const std::string& speed) {
    Results replayed;
    LcmBus bus(url);
    std::vector<std::string> heard = compared;
    heard.emplace_back("REFINEMENT");
    for (const auto& channel : heard) {
        bus.subscribe(channel, Delivery::every, [&replayed, channel](std::span<const std::uint8_t> bytes) {
            collect(replayed, channel, bytes);
        });
    }
    test::RunningGraph graph(test::shipped_graph("replay"));
    EXPECT_TRUE(graph.until([&] {
        const auto processes = graph.launcher().processes();
        return std::all_of(processes.begin(), processes.end(),
                           [](const ProcessReport& process) { return process.status.has_value(); });
    })) << graph.story();
    test::Running player({"lcm-logplayer", std::string("--lcm-url=") + url, "--speed=" + speed,
                          "--regexp=(IMAGE_TAP|IMAGE_SLICES|ODOMETRY|KINEMATICS)", log.string()},
                         mark);
    graph.until(
        [&] {
            bus.dispatch(std::chrono::milliseconds(1));
            return replayed["POSTS"].contains(last) && replayed["POSE"].contains(last);
        },
        std::chrono::seconds(30));
    return replayed;
}

/// Frames that the refinement process did not get whole are lost to it, and it says so.
void forget_frames_without_picture(Results& replayed) {
    for (const auto& [seq, bytes] : replayed["REFINEMENT"]) {
        refinement_t how{};
        ASSERT_FALSE(decode(bytes, how));
        for (const refined_post_t& post : how.posts)
            if (post.reason == "no picture") replayed["POSTS_REFINED"].erase(seq);
    }
}

struct Differences {
    int lost = 0;       // frames that the log has and the replay has not
    int different = 0;  // frames with other bytes
};

Differences compare(const std::map<std::int64_t, Bytes>& recorded,
                    const std::map<std::int64_t, Bytes>& replayed) {
    Differences result;
    for (const auto& [seq, bytes] : recorded) {
        const auto found = replayed.find(seq);
        if (found == replayed.end()) {
            ++result.lost;
        } else if (found->second != bytes) {
            ++result.different;
        }
    }
    return result;
}

// LCM loses datagrams where a machine has no time for a receiver: such a run is made again. A frame that
// comes through has the same bytes in any case, and poses too unless a frame before them was lost.
void expect_the_same_bytes(void (*record)(const std::filesystem::path&, const std::string&),
                           std::size_t frames, const std::string& speed = "1") {
    const test::TemporaryFolder folder;
    const auto log = folder.path() / "run.lcmlog";
    const std::string mark = test::new_mark();
    int lost = 0;
    for (int attempt = 0; attempt < 3; ++attempt) {
        record(log, mark);
        if (testing::Test::HasFatalFailure()) return;
        Results recorded;
        for (const LogEvent& event : read_log(log)) collect(recorded, event.channel, event.data);
        ASSERT_GE(recorded["SEGMENTS"].size(), frames);
        Results replayed = replay(log, recorded["POSTS"].rbegin()->first, mark, speed);
        forget_frames_without_picture(replayed);
        lost = 0;
        for (const auto& channel : compared) {
            const Differences differences = compare(recorded[channel], replayed[channel]);
            lost += differences.lost;
            if (channel == "POSE" && lost > 0) continue;
            EXPECT_EQ(differences.different, 0)
                << channel << ": of " << recorded[channel].size() << " frames";
        }
        if (lost == 0) break;
        std::cout << lost << " messages lost in attempt " << attempt + 1 << '\n';
    }
    EXPECT_EQ(lost, 0) << "in each of three attempts";
}

TEST(Replay, FromTheTapsLogGivesTheBytesThatSharedMemoryGave) {
    expect_the_same_bytes(record_with_logger, 60);
}

TEST(Replay, FromALogThatTheTapWroteGivesTheBytesThatSharedMemoryGave) {
    expect_the_same_bytes(record_with_tap, 20);
}

TEST(Replay, TwoMegapixelsFromTheTapsLogComeThroughAtATenthOfTheSpeed) {
    expect_the_same_bytes(record_two_megapixels, 3, "0.1");
}

}  // namespace
}  // namespace goalmouth
