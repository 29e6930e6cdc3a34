// What detection and localisation find in logs/walk.lcmlog is what they found when it was recorded.

#include "core/messaging/channels.h"
#include "core/messaging/log_bus.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/graph.h"
#include "tools/goalmouth/registry.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <goalmouth/pose_t.hpp>
#include <goalmouth/posts_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

const std::filesystem::path project = GOALMOUTH_SOURCE_DIR;

using Bytes = std::vector<std::uint8_t>;
/// Messages of one channel by the number of their frame.
using Messages = std::map<std::int64_t, Bytes>;

template <class Message>
void collect(Bus& bus, const std::string& channel, Messages& messages) {
    bus.subscribe(channel, Delivery::every, [channel, &messages](std::span<const std::uint8_t> bytes) {
        Message message{};
        const auto problem = decode(bytes, message);
        ASSERT_FALSE(problem) << channel << ": " << *problem;
        messages[message.seq] = Bytes(bytes.begin(), bytes.end());
    });
}

template <class Message>
Message decoded(const Bytes& bytes) {
    Message message{};
    decode(bytes, message);
    return message;
}

std::string text_of(const posts_t& m) {
    std::ostringstream text;
    text.precision(17);
    text << m.num_posts << " posts";
    for (const auto& post : m.posts) text << ", " << post.distance_m << " m " << post.bearing_rad << " rad";
    return text.str();
}

std::string text_of(const pose_t& m) {
    std::ostringstream text;
    text.precision(17);
    text << m.x << " m " << m.y << " m " << m.theta << " rad";
    return text.str();
}

/// What two runs found, frame by frame; of those that differ, the first is shown.
template <class Message>
void expect_same(const std::string& channel, const Messages& recorded, const Messages& now) {
    std::string first;
    int different = 0;
    for (const auto& [seq, bytes] : recorded) {
        const auto found = now.find(seq);
        if (found != now.end() && found->second == bytes) continue;
        if (different++ > 0) continue;
        first = "frame " + std::to_string(seq) + ": recorded " + text_of(decoded<Message>(bytes)) + "; now " +
                (found == now.end() ? "nothing" : text_of(decoded<Message>(found->second)));
    }
    EXPECT_EQ(different, 0)
        << channel << " differs in " << different << " of " << recorded.size() << " frames, first in "
        << first
        << "\nWhere this change is meant to find something else, make logs/walk.lcmlog anew as "
           "logs/README.md says; where it is not, it is a mistake.";
}

TEST(WalkLog, GivesThePostsAndPosesThatItHolds) {
#ifndef __x86_64__
    GTEST_SKIP() << "skipped: the log was recorded on x86-64, whose arithmetic differs in the last digits";
#endif
    MemoryHub hub;
    LogBus log({.input = project / "logs" / "walk.lcmlog", .output = {}});
    Messages recorded_posts;
    Messages recorded_poses;
    collect<posts_t>(log, channels::posts, recorded_posts);
    collect<pose_t>(log, channels::pose, recorded_poses);
    Messages posts;
    Messages poses;
    collect<posts_t>(hub.endpoint("listener"), channels::posts, posts);
    collect<pose_t>(hub.endpoint("listener"), channels::pose, poses);

    GraphOptions options;
    options.describe = describe_module;
    const Graph graph =
        load_graph((project / "config" / "graphs" / "replay_candidates.yaml").string(), options);
    ASSERT_EQ(graph.processes.size(), 2U);
    for (const std::string& channel : graph.external) {
        log.subscribe(channel, Delivery::every, [&hub, channel](std::span<const std::uint8_t> bytes) {
            hub.endpoint("log").publish(channel, bytes);
        });
    }
    Status status;
    std::vector<std::unique_ptr<ModuleContext>> contexts;
    std::vector<std::unique_ptr<Module>> modules;
    for (const GraphProcess& process : graph.processes) {
        contexts.push_back(std::make_unique<ModuleContext>(
            ModuleContext{hub.endpoint(process.name), status, process.name, graph.seed, process.channels}));
        modules.push_back(
            find_module_type(process.executable)->create(*contexts.back(), process.configuration()));
    }

    while (log.dispatch(std::chrono::milliseconds(0))) hub.run_until_idle();
    EXPECT_EQ(log.damaged_stretches(), 0);
    ASSERT_EQ(recorded_posts.size(), 100U);
    ASSERT_EQ(recorded_poses.size(), 100U);
    expect_same<posts_t>(channels::posts, recorded_posts, posts);
    expect_same<pose_t>(channels::pose, recorded_poses, poses);
}

}  // namespace
}  // namespace goalmouth
