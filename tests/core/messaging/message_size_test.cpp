// What is too large for a datagram, over real sockets.

#include "core/messaging/message_size.h"

#include "core/messaging/lcm_bus.h"
#include "tests/support/network.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

namespace goalmouth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr const char* url = "udpm://239.255.76.67:7667?ttl=0";

/// What is logged while it lives.
class LogText {
  public:
    LogText() : before_(spdlog::default_logger()) {
        spdlog::set_default_logger(std::make_shared<spdlog::logger>(
            "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_, true)));
    }
    ~LogText() { spdlog::set_default_logger(before_); }
    LogText(const LogText&) = delete;
    LogText& operator=(const LogText&) = delete;
    std::string text() const { return text_.str(); }
    int lines() const {
        const std::string all = text();
        return static_cast<int>(std::count(all.begin(), all.end(), '\n'));
    }

  private:
    std::ostringstream text_;
    std::shared_ptr<spdlog::logger> before_;
};

std::vector<std::uint8_t> bytes(std::size_t count) {
    return std::vector<std::uint8_t>(count, 7);
}

/// Publishes one message; whether it came, dispatching until a small one behind it did.
bool arrives(LcmBus& sender, std::size_t size) {
    LcmBus receiver(url);
    std::size_t heard = 0;
    bool end = false;
    receiver.subscribe("LARGE", Delivery::every, [&](auto message) { heard = message.size(); });
    receiver.subscribe("END", Delivery::every, [&](auto) { end = true; });
    sender.publish("LARGE", bytes(size));
    const auto limit = std::chrono::steady_clock::now() + 20s;
    while (!end && std::chrono::steady_clock::now() < limit) {
        sender.publish("END", {});
        receiver.dispatch(20ms);
    }
    return heard == size;
}

TEST(MessageSize, BuffersAreThoseOfTheSystem) {
    const ReceiveBuffers buffers = receive_buffers();
    EXPECT_GE(buffers.usual, 2048U);
    EXPECT_GE(buffers.largest, buffers.usual);
}

TEST(MessageSize, OnlyUdpHasLimits) {
    EXPECT_EQ(size_limits("memq://").datagram, std::numeric_limits<std::size_t>::max());
    EXPECT_EQ(size_limits("tcpq://localhost:7700").deliverable, std::numeric_limits<std::size_t>::max());
    EXPECT_EQ(size_limits(url).datagram, 65499U);
}

TEST(MessageSize, ReceiversElsewhereMayHaveLargerBuffers) {
    EXPECT_EQ(size_limits(url).deliverable, receive_buffers().largest);
    EXPECT_EQ(size_limits("udpm://239.255.76.67:7667?ttl=1").deliverable, std::size_t{1} << 28);
}

TEST(MessageSize, WhatFillsADatagramGoesWithoutAWord) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    const LogText log;
    LcmBus sender(url);
    EXPECT_TRUE(arrives(sender, 65499 - sizeof "LARGE"));
    EXPECT_EQ(sender.counters().oversized, 0);
    EXPECT_EQ(log.text(), "");
}

TEST(MessageSize, AByteMoreIsSentAndWarnedAboutOnceAChannel) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    const LogText log;
    LcmBus sender(url);
    const std::size_t size = 65500 - sizeof "LARGE";
    EXPECT_TRUE(arrives(sender, size));
    sender.publish("LARGE", bytes(size));
    EXPECT_EQ(sender.counters().oversized, 2);
    EXPECT_EQ(sender.counters().rejected_total(), 0);
    EXPECT_EQ(log.lines(), 1) << log.text();
    EXPECT_THAT(log.text(), HasSubstr("LARGE: a message of 65500 bytes"));
    EXPECT_THAT(log.text(), HasSubstr("2 fragments"));
    EXPECT_THAT(log.text(), HasSubstr("larger spacing"));
    EXPECT_THAT(log.text(), HasSubstr("net.core.rmem_max=131000"));
    sender.publish("OTHER", bytes(70000));
    EXPECT_EQ(log.lines(), 2) << log.text();
}

TEST(MessageSize, WhatNoReceiverCanHoldIsNotSent) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    const LogText log;
    LcmBus sender(url);
    const std::size_t largest = receive_buffers().largest;
    EXPECT_FALSE(arrives(sender, largest));
    const std::int64_t published = sender.counters().published;
    sender.publish("LARGE", bytes(largest + 1000));
    EXPECT_EQ(sender.counters().published, published);
    EXPECT_EQ(sender.counters().rejected_total(), 2);
    EXPECT_EQ(sender.counters().oversized, 0);
    EXPECT_EQ(log.lines(), 1) << log.text();
    EXPECT_THAT(log.text(), HasSubstr("not sent"));
    EXPECT_THAT(log.text(), HasSubstr(std::to_string(largest)));
    EXPECT_THAT(log.text(), HasSubstr("sysctl -w net.core.rmem_max="));
}

TEST(MessageSize, NobodyIsToldToEnlargeBuffersForWhatNoBufferHelps) {
    const SizeLimits limits = size_limits("udpm://239.255.76.67:7667?ttl=1");
    const std::size_t largest = std::size_t{1} << 28;
    EXPECT_THAT(undeliverable_text(largest, limits), HasSubstr("rmem_max=536870912"));
    for (const std::size_t size : {largest + 1, std::size_t{1} << 31, SIZE_MAX}) {
        EXPECT_THAT(undeliverable_text(size, limits), HasSubstr("larger spacing"));
        EXPECT_THAT(undeliverable_text(size, limits), testing::Not(HasSubstr("rmem")));
    }
}

TEST(MessageSize, WithinAProcessSizeDoesNotMatter) {
    LcmBus bus("memq://");
    std::size_t heard = 0;
    bus.subscribe("LARGE", Delivery::every, [&](auto message) { heard = message.size(); });
    bus.publish("LARGE", bytes(4'000'000));
    bus.dispatch(10s);
    EXPECT_EQ(heard, 4'000'000U);
    EXPECT_EQ(bus.counters().rejected_total(), 0);
}

}  // namespace
}  // namespace goalmouth
