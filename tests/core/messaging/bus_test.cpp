#include "core/messaging/bus.h"

#include "core/messaging/lcm_bus.h"
#include "core/messaging/log_bus.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "tests/support/data.h"
#include "tests/support/example_messages.h"
#include "tests/support/network.h"

#include <functional>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using namespace std::chrono_literals;

using Use = std::function<void(Bus&)>;

/// What one program sends, another one receives; by each kind of bus.
class Exchange {
  public:
    virtual ~Exchange() = default;
    /// Runs `subscribe`, then `send`, then delivers until `enough` is true or nothing more can come.
    virtual void run(const Use& subscribe, const Use& send, const std::function<bool()>& enough) = 0;
    BusCounters received;
};

class MemoryExchange : public Exchange {
    void run(const Use& subscribe, const Use& send, const std::function<bool()>&) override {
        MemoryHub hub;
        subscribe(hub.endpoint("receiver"));
        send(hub.endpoint("sender"));
        hub.run_until_idle();
        received = hub.endpoint("receiver").counters();
    }
};

class LogExchange : public Exchange {
    void run(const Use& subscribe, const Use& send, const std::function<bool()>&) override {
        const TemporaryFolder folder;
        {
            LogBus writer({"", folder.path() / "log"});
            send(writer);
        }
        LogBus reader({folder.path() / "log", ""});
        subscribe(reader);
        while (!reader.finished()) reader.dispatch(0ms);
        received = reader.counters();
    }
};

class LcmExchange : public Exchange {
    void run(const Use& subscribe, const Use& send, const std::function<bool()>& enough) override {
        LcmBus receiver;
        LcmBus sender;
        subscribe(receiver);
        send(sender);
        const auto limit = std::chrono::steady_clock::now() + 20s;
        while (!enough() && std::chrono::steady_clock::now() < limit) receiver.dispatch(100ms);
        received = receiver.counters();
    }
};

class AnyBus : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        const std::string kind = GetParam();
        if (kind == "Lcm") {
            GOALMOUTH_NEEDS_PRIVATE_NETWORK();
            exchange = std::make_unique<LcmExchange>();
        } else if (kind == "Memory") {
            exchange = std::make_unique<MemoryExchange>();
        } else {
            exchange = std::make_unique<LogExchange>();
        }
    }
    std::unique_ptr<Exchange> exchange;
};

INSTANTIATE_TEST_SUITE_P(, AnyBus, testing::Values("Memory", "Log", "Lcm"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST_P(AnyBus, DeliversTypedMessagesInOrder) {
    std::vector<std::int64_t> seqs;
    std::vector<std::uint8_t> last;
    exchange->run(
        [&](Bus& bus) {
            subscribe<posts_t>(bus, "POSTS", [&](const posts_t& m) {
                seqs.push_back(m.seq);
                last = encoded(m);
            });
        },
        [&](Bus& bus) {
            auto posts = example_posts();
            for (posts.seq = 0; posts.seq < 20; ++posts.seq) publish(bus, "POSTS", posts);
            EXPECT_EQ(bus.counters().published, 20);
        },
        [&] { return seqs.size() == 20; });
    ASSERT_EQ(seqs.size(), 20U);
    for (std::size_t i = 0; i < seqs.size(); ++i) EXPECT_EQ(seqs[i], static_cast<std::int64_t>(i));
    auto expected = example_posts();
    expected.seq = 19;
    EXPECT_EQ(last, encoded(expected));
    EXPECT_EQ(exchange->received.received, 20);
    EXPECT_EQ(exchange->received.rejected_total(), 0);
}

TEST_P(AnyBus, CountsAndSkipsWhatIsNoMessage) {
    int good = 0;
    exchange->run(
        [&](Bus& bus) { subscribe<odometry_t>(bus, "ODOMETRY", [&](const odometry_t&) { ++good; }); },
        [&](Bus& bus) {
            auto not_finite = example_odometry();
            not_finite.x = 0.0 / 0.0;
            bus.publish("ODOMETRY", encoded(not_finite));
            bus.publish("ODOMETRY", std::vector<std::uint8_t>{1, 2, 3});
            bus.publish("ODOMETRY", encoded(example_pose()));
            publish(bus, "ODOMETRY", example_odometry());
        },
        [&] { return good == 1; });
    EXPECT_EQ(good, 1);
    EXPECT_EQ(exchange->received.received, 4);
    EXPECT_EQ(exchange->received.rejected_total(), 3);
    EXPECT_EQ(exchange->received.rejected.at("ODOMETRY: not of type odometry_t"), 2);
}

TEST_P(AnyBus, ChannelNamesAreExact) {
    // As a regular expression "A.B+" would also be "AxB", and would not be itself.
    std::vector<std::string> heard;
    bool end = false;
    const std::vector<std::string> names = {"A.B+",  "AxB",    "A.B", "a.b+", "A.B+C",
                                            "XA.B+", "A(1)|B", "B",   "A_B-1"};
    exchange->run(
        [&](Bus& bus) {
            for (const std::string name : {"A.B+", "A(1)|B", "A_B-1"}) {
                subscribe<odometry_t>(bus, name,
                                      [&heard, name](const odometry_t&) { heard.push_back(name); });
            }
            subscribe<odometry_t>(bus, "END", [&](const odometry_t&) { end = true; });
        },
        [&](Bus& bus) {
            for (const auto& name : names) publish(bus, name, example_odometry());
            publish(bus, "END", example_odometry());
        },
        [&] { return end; });
    EXPECT_EQ(heard, (std::vector<std::string>{"A.B+", "A(1)|B", "A_B-1"}));
}

TEST_P(AnyBus, SeveralSubscriptionsOfAChannelAllHear) {
    int first = 0;
    int second = 0;
    exchange->run(
        [&](Bus& bus) {
            subscribe<odometry_t>(bus, "ODOMETRY", [&](const odometry_t&) { ++first; });
            subscribe<odometry_t>(bus, "ODOMETRY", [&](const odometry_t&) { ++second; });
        },
        [&](Bus& bus) { publish(bus, "ODOMETRY", example_odometry()); }, [&] { return first + second == 2; });
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 1);
}

TEST_P(AnyBus, AnInvalidMessageIsNotSentButCounted) {
    int heard = 0;
    bool end = false;
    exchange->run(
        [&](Bus& bus) {
            subscribe<particles_t>(bus, "PARTICLES", [&](const particles_t&) { ++heard; });
            subscribe<odometry_t>(bus, "END", [&](const odometry_t&) { end = true; });
        },
        [&](Bus& bus) {
            auto broken = example_particles();
            broken.num_particles = 100;  // the encoder would read beyond the arrays
            publish(bus, "PARTICLES", broken);
            publish(bus, "END", example_odometry());
            EXPECT_EQ(bus.counters().rejected_total(), 1);
            EXPECT_EQ(bus.counters().published, 1);
        },
        [&] { return end; });
    EXPECT_EQ(heard, 0);
    EXPECT_TRUE(end);
}

TEST_P(AnyBus, CarriesAnEmptyMessage) {
    std::vector<std::size_t> sizes;
    exchange->run(
        [&](Bus& bus) {
            bus.subscribe("X", Delivery::every, [&](auto bytes) { sizes.push_back(bytes.size()); });
        },
        [&](Bus& bus) {
            bus.publish("X", {});
            bus.publish("X", std::vector<std::uint8_t>(60000, 1));
        },
        [&] { return sizes.size() == 2; });
    EXPECT_EQ(sizes, (std::vector<std::size_t>{0, 60000}));
}

TEST(MemoryHub, DeliversTheNewestOnceNothingElseWaits) {
    MemoryHub hub;
    std::vector<std::string> heard;
    auto& receiver = hub.endpoint("receiver");
    receiver.subscribe("IMAGE", Delivery::newest,
                       [&](auto bytes) { heard.push_back("image " + std::to_string(bytes[0])); });
    receiver.subscribe("ODOMETRY", Delivery::every,
                       [&](auto bytes) { heard.push_back("odometry " + std::to_string(bytes[0])); });
    for (std::uint8_t i = 0; i < 3; ++i) {
        hub.endpoint("camera").publish("IMAGE", std::vector<std::uint8_t>{i});
        hub.endpoint("walk").publish("ODOMETRY", std::vector<std::uint8_t>{i});
    }
    EXPECT_TRUE(receiver.dispatch(0ms));
    EXPECT_EQ(heard, (std::vector<std::string>{"odometry 0", "odometry 1", "odometry 2", "image 2"}));
    EXPECT_EQ(receiver.counters().superseded, 2);
    EXPECT_EQ(receiver.counters().received, 4);
    EXPECT_FALSE(receiver.dispatch(0ms));
}

TEST(MemoryHub, RunsAChainToItsEndInTheSameOrderEachTime) {
    const auto run = [] {
        MemoryHub hub;
        std::string trace;
        const auto stage = [&](const std::string& name, const std::string& in, const std::string& out) {
            Bus& bus = hub.endpoint(name);
            bus.subscribe(in, Delivery::every, [&trace, &bus, name, out](auto bytes) {
                trace += name + std::to_string(bytes[0]) + " ";
                bus.publish(out, bytes);
            });
        };
        stage("a", "IN", "MIDDLE");
        stage("b", "MIDDLE", "OUT");
        stage("c", "MIDDLE", "OUT");
        stage("d", "OUT", "END");
        for (std::uint8_t i = 0; i < 2; ++i)
            hub.endpoint("source").publish("IN", std::vector<std::uint8_t>{i});
        hub.run_until_idle();
        return trace;
    };
    EXPECT_EQ(run(), "a0 a1 b0 c0 b1 c1 d0 d0 d1 d1 ");
    EXPECT_EQ(run(), run());
}

TEST(MemoryHub, MeasuresTheTimeOfEachEndpoint) {
    MemoryHub hub;
    hub.endpoint("slow").subscribe("X", Delivery::every, [](auto) { usleep(20'000); });
    hub.endpoint("quick").subscribe("X", Delivery::every, [](auto) {});
    hub.endpoint("slow").publish("X", {});
    hub.run_until_idle();
    EXPECT_GE(hub.endpoint("slow").time_spent(), 20ms);
    EXPECT_LT(hub.endpoint("quick").time_spent(), hub.endpoint("slow").time_spent());
}

TEST(MemoryHub, DispatchInsideAHandlerDoesNothing) {
    MemoryHub hub;
    Bus& bus = hub.endpoint("a");
    int heard = 0;
    bus.subscribe("X", Delivery::every, [&](auto) {
        if (++heard == 1) bus.publish("X", {});
        EXPECT_FALSE(bus.dispatch(0ms));
    });
    bus.publish("X", {});
    EXPECT_TRUE(bus.dispatch(0ms));
    EXPECT_EQ(heard, 2);
}

TEST(MemoryHub, AnExceptionLeavesAndTheRestStaysDeliverable) {
    MemoryHub hub;
    Bus& bus = hub.endpoint("a");
    int heard = 0;
    bus.subscribe("X", Delivery::every, [&](auto) {
        if (++heard == 1) throw std::runtime_error("first");
    });
    bus.publish("X", {});
    bus.publish("X", {});
    EXPECT_THROW(bus.dispatch(0ms), std::runtime_error);
    EXPECT_TRUE(bus.dispatch(0ms));
    EXPECT_EQ(heard, 2);
}

}  // namespace
}  // namespace goalmouth
