#include "core/messaging/tap_url.h"

#include "core/messaging/message_size.h"
#include "core/messaging/multicast.h"

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr const char* graph = "udpm://239.255.76.67:7667?ttl=0";

std::string refusal(const std::string& graph_url, const std::string& setting) {
    try {
        return "no refusal, but " + tap_url(graph_url, setting);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

TEST(TapUrl, IsTheGraphsOnAPortAThousandHigher) {
    EXPECT_EQ(tap_url(graph), "udpm://239.255.76.67:8667?ttl=0");
    EXPECT_EQ(tap_url("udpm://239.255.76.70:7001?ttl=1&recv_buf_size=1000000"),
              "udpm://239.255.76.70:8001?ttl=1&recv_buf_size=1000000");
}

TEST(TapUrl, FillsInWhatTheGraphsLeavesToLcm) {
    EXPECT_EQ(tap_url("udpm://239.255.76.67?ttl=0"), "udpm://239.255.76.67:8667?ttl=0");
    EXPECT_EQ(tap_url("udpm://"), "udpm://239.255.76.67:8667");
    EXPECT_EQ(tap_url("udpm://?ttl=1"), "udpm://239.255.76.67:8667?ttl=1");
}

TEST(TapUrl, NeighbouringRobotsAndTheirTapsNeverMeet) {
    for (int robot = 0; robot < 100; ++robot) {
        const std::string url = "udpm://239.255.76.67:" + std::to_string(7667 + robot) + "?ttl=0";
        for (int other = 0; other < 100; ++other) {
            EXPECT_FALSE(same_traffic(tap_url(url),
                                      "udpm://239.255.76.67:" + std::to_string(7667 + other) + "?ttl=0"));
        }
    }
}

TEST(TapUrl, IsTheGraphsOwnWhereItIsAskedForOrHasNoPort) {
    EXPECT_EQ(tap_url(graph, "graph"), graph);
    EXPECT_EQ(tap_url(graph, graph), graph);
    EXPECT_EQ(tap_url("tcpq://localhost:7700"), "tcpq://localhost:7700");
}

TEST(TapUrl, IsWhateverIsNamed) {
    EXPECT_EQ(tap_url(graph, "udpm://239.255.76.67:9999?ttl=0"), "udpm://239.255.76.67:9999?ttl=0");
}

TEST(TapUrl, ThePortOfTheGraphUnderAnotherGroupIsRefused) {
    EXPECT_NE(refusal(graph, "udpm://239.255.76.68:7667?ttl=0").find("another port"), std::string::npos);
}

TEST(TapUrl, WhatIsNoUrlOrNoPortIsRefused) {
    EXPECT_NE(refusal(graph, "8667").find("udpm://"), std::string::npos) << refusal(graph, "8667");
    EXPECT_NE(refusal("udpm://239.255.76.67:65000?ttl=0", "own").find("64535"), std::string::npos);
}

TEST(TapUrl, TrafficIsSharedByPort) {
    EXPECT_TRUE(same_traffic(graph, "udpm://239.255.76.99:7667?ttl=1"));
    EXPECT_TRUE(same_traffic("memq://", "memq://"));
    EXPECT_FALSE(same_traffic(graph, "udpm://239.255.76.67:7668?ttl=0"));
    EXPECT_FALSE(same_traffic("memq://", "tcpq://localhost:7700"));
}

/// $LCM_DEFAULT_URL while it lives; nothing = not set.
class DefaultUrl {
  public:
    explicit DefaultUrl(std::optional<std::string> url) {
        if (const char* former = std::getenv(name)) former_ = former;
        set(url);
    }
    ~DefaultUrl() { set(former_); }
    DefaultUrl(const DefaultUrl&) = delete;
    DefaultUrl& operator=(const DefaultUrl&) = delete;

  private:
    static constexpr const char* name = "LCM_DEFAULT_URL";
    static void set(const std::optional<std::string>& url) {
        url ? ::setenv(name, url->c_str(), 1) : ::unsetenv(name);
    }
    std::optional<std::string> former_;
};

TEST(EffectiveLcmUrl, IsTheOneGivenThenTheVariablesThenLcmsOwn) {
    for (const auto& unset : {std::optional<std::string>{}, std::optional<std::string>{""}}) {
        const DefaultUrl variable(unset);
        EXPECT_EQ(effective_lcm_url(""), graph);
        EXPECT_EQ(effective_lcm_url("memq://"), "memq://");
        EXPECT_EQ(udp_port(""), 7667);
        EXPECT_EQ(tap_url(""), "udpm://239.255.76.67:8667?ttl=0");
        EXPECT_EQ(size_limits("").datagram, size_limits(graph).datagram);
    }
    const DefaultUrl variable("memq://");
    EXPECT_EQ(effective_lcm_url(""), "memq://");
    EXPECT_EQ(effective_lcm_url(graph), graph);
    EXPECT_EQ(udp_port(""), 0);
    EXPECT_EQ(tap_url(""), "memq://");
    EXPECT_EQ(size_limits("").datagram, size_limits("memq://").datagram);
}

}  // namespace
}  // namespace goalmouth
