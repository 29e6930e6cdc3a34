// What the tap sends on a port of its own.

#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "tests/modules/tap/tap_fixture.h"

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

TEST_F(TapBetween, FramesGoToItsOwnPortOnly) {
    start({.encoding = "raw"});
    send(0);
    settle();
    EXPECT_EQ(opened, std::vector<std::string>{"udpm://239.255.76.67:8667?ttl=0"});
    EXPECT_EQ(count(on_own, "IMAGE_TAP"), 1);
    EXPECT_EQ(count(on_graph, "IMAGE_TAP"), 0);
}

TEST_F(TapBetween, MessagesOfTheGraphAreForwardedByteForByteInTheirOrder) {
    start({});
    Heard sent;
    for (std::uint8_t i = 0; i < 100; ++i) {
        const std::string channel = i % 3 == 0 ? "POSE" : "SOMETHING_OF_A_USER";
        say(channel, i);
        sent.emplace_back(channel, std::vector<std::uint8_t>{i});
    }
    settle();
    EXPECT_EQ(on_own, sent);
    EXPECT_EQ(status.counters().at("forwarded"), 100.0);
}

TEST_F(TapBetween, OnlyChannelsThatAreChosenAreForwarded) {
    start({.forward_channels = "(POSTS|POSE)"});
    for (const char* channel : {"POSTS", "POSE", "POSE2", "SEGMENTS", "XPOSE"}) say(channel, 1);
    settle();
    EXPECT_EQ(on_own, (Heard{{"POSTS", {1}}, {"POSE", {1}}}));
}

TEST_F(TapBetween, WithoutForwardingOnlyFramesGoThere) {
    start({.forward = false, .encoding = "raw"});
    say("POSE", 1);
    send(0);
    settle();
    ASSERT_EQ(on_own.size(), 1U);
    EXPECT_EQ(on_own[0].first, "IMAGE_TAP");
}

TEST_F(TapBetween, NothingComesBack) {
    start({});
    own.endpoint("somebody").publish("POSE", std::vector<std::uint8_t>{1});
    settle();
    EXPECT_TRUE(on_graph.empty());
}

TEST_F(TapBetween, OnTheGraphsOwnPortNothingIsForwarded) {
    start({.url = "graph", .encoding = "raw"});
    say("POSE", 1);
    send(0);
    settle();
    graph.run_until_idle();
    EXPECT_TRUE(opened.empty());
    EXPECT_EQ(count(on_graph, "POSE"), 1);
    EXPECT_EQ(count(on_graph, "IMAGE_TAP"), 1);
    EXPECT_TRUE(on_own.empty());
}

/// A network that refuses what is larger than 10 bytes and warns from 5 on.
class NarrowBus : public Bus {
  public:
    void publish(const std::string& channel, std::span<const std::uint8_t> message) override {
        if (message.size() > 10) {
            reject(channel, "too large");
            return;
        }
        ++counters_.published;
        if (message.size() >= 5) ++counters_.oversized;
    }
    void subscribe(const std::string&, Delivery, Handler) override {}
    void subscribe_all(ChannelHandler) override {}
    bool dispatch(std::chrono::milliseconds) override { return false; }
};

TEST_F(TapBetween, WhatItsOwnPortRefusesIsCountedAndNotForwarded) {
    context.open_bus = [](const std::string&) { return std::make_shared<NarrowBus>(); };
    start({});
    for (const std::size_t size : {3U, 5U, 10U, 11U})
        graph.endpoint("somebody").publish("POSE", std::vector<std::uint8_t>(size, 1));
    settle();
    EXPECT_EQ(status.counters().at("forwarded"), 3.0);
    EXPECT_EQ(status.counters().at("oversized"), 2.0);
    EXPECT_EQ(status.counters().at("rejected"), 1.0);
}

TEST_F(TapBetween, AWrongUrlOrExpressionIsAConfigurationError) {
    for (const auto& [parameters, words] : std::vector<std::pair<TapParameters, std::string>>{
             {{.url = "8667"}, "url"},
             {{.url = "udpm://239.255.76.68:7667?ttl=0"}, "another port"},
             {{.url = "off"}, "file"},
             {{.file = "/no/such/folder/x.lcmlog"}, "file"},
             {{.forward_channels = "(POSE"}, "forward_channels"}}) {
        try {
            TapModule module(context, parameters);
            ADD_FAILURE() << "accepted: " << words;
        } catch (const ConfigurationError& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace goalmouth
