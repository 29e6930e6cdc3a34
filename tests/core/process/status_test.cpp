#include "core/process/status.h"

#include "core/messaging/clock.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"

#include <unistd.h>

#include <goalmouth/counter_t.hpp>
#include <goalmouth/status_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

class StatusReport : public testing::Test {
  protected:
    status_t report() {
        status.report(hub.endpoint("module"), "STATUS", "eyes", "camera", status_t::RUNNING);
        hub.run_until_idle();
        return last;
    }
    void SetUp() override {
        subscribe<status_t>(hub.endpoint("listener"), "STATUS", [this](const status_t& m) { last = m; });
    }

    MemoryHub hub;
    Status status;
    status_t last{};
};

TEST_F(StatusReport, SaysWhoItIsAndWhatItCounted) {
    status.dropped(3);
    status.count("frames_gone");
    status.count("frames_gone");
    status.set("temperature", 36.6);
    const status_t m = report();
    EXPECT_EQ(m.process, "eyes");
    EXPECT_EQ(m.executable, "camera");
    EXPECT_EQ(m.pid, getpid());
    EXPECT_EQ(m.state, status_t::RUNNING);
    EXPECT_EQ(m.dropped, 3);
    ASSERT_EQ(m.num_counters, 2);
    EXPECT_EQ(m.counters[0].name, "frames_gone");
    EXPECT_EQ(m.counters[0].value, 2.0);
    EXPECT_EQ(m.counters[1].value, 36.6);
}

TEST_F(StatusReport, MeasuresLatencyAgainstTheCaptureTime) {
    const std::int64_t now = now_utime();
    status.output(now - 1'000'000);
    status.output(now - 1'000'000);
    status.output(now - 2'000'000);
    const status_t m = report();
    EXPECT_GE(m.latency_p50, 1.0);
    EXPECT_LT(m.latency_p50, 2.0);
    EXPECT_GE(m.latency_p99, 2.0);
    EXPECT_EQ(status.outputs(), 3);
}

TEST_F(StatusReport, ClaimsNoLatencyForReplayedData) {
    status.output(now_utime() - 3'600'000'000);
    EXPECT_EQ(report().latency_p50, -1.0);
}

TEST_F(StatusReport, ClaimsNoLatencyWithoutOutput) {
    EXPECT_EQ(report().latency_p99, -1.0);
}

TEST_F(StatusReport, ForgetsTheLatenciesItReported) {
    status.output(now_utime() - 1'000'000);
    report();
    EXPECT_EQ(report().latency_p50, -1.0);
}

TEST(StatusOfABus, SaysHowManyMessagesWereLargerThanADatagram) {
    struct CountingBus : Bus {
        CountingBus() { counters_.oversized = 3; }
        void publish(const std::string&, std::span<const std::uint8_t> bytes) override {
            sent.assign(bytes.begin(), bytes.end());
        }
        void subscribe(const std::string&, Delivery, Handler) override {}
        void subscribe_all(ChannelHandler) override {}
        bool dispatch(std::chrono::milliseconds) override { return false; }
        std::vector<std::uint8_t> sent;
    } bus;
    Status status;
    status.report(bus, "STATUS", "eyes", "camera", status_t::RUNNING);
    status_t m{};
    ASSERT_FALSE(decode(bus.sent, m));
    ASSERT_EQ(m.num_counters, 1);
    EXPECT_EQ(m.counters[0].name, "oversized");
    EXPECT_EQ(m.counters[0].value, 3.0);
}

}  // namespace
}  // namespace goalmouth
