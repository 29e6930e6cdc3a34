#include "core/messaging/lcm_bus.h"

#include "core/messaging/multicast.h"
#include "core/messaging/typed.h"
#include "tests/support/example_messages.h"
#include "tests/support/network.h"

#include <arpa/inet.h>
#include <atomic>
#include <chrono>
#include <netinet/in.h>
#include <random>
#include <sched.h>
#include <signal.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Dispatches until `done` or for 20 s at most.
template <class Done>
bool dispatch_until(Bus& bus, Done done) {
    const auto limit = Clock::now() + 20s;
    while (!done() && Clock::now() < limit) bus.dispatch(50ms);
    return done();
}

TEST(LcmBus, DeliversTheNewestOfThoseThatWait) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    LcmBus receiver;
    LcmBus sender;
    std::vector<std::uint8_t> newest;
    int end = 0;
    receiver.subscribe("IMAGE", Delivery::newest, [&](auto bytes) { newest.push_back(bytes[0]); });
    receiver.subscribe("END", Delivery::every, [&](auto) { ++end; });
    for (std::uint8_t i = 0; i < 10; ++i) sender.publish("IMAGE", std::vector<std::uint8_t>{i});
    sender.publish("END", {});
    ASSERT_TRUE(dispatch_until(receiver, [&] { return end == 1; }));
    ASSERT_FALSE(newest.empty());
    EXPECT_EQ(newest.back(), 9);
    EXPECT_EQ(receiver.counters().superseded + static_cast<std::int64_t>(newest.size()), 10);
}

TEST(LcmBus, KeepsABurstOfFiveHundredSlices) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    // A machine that gives LCM's own thread no time loses datagrams in the kernel: that is another try.
    constexpr int attempts = 5;
    constexpr int slices = 500;
    int heard = 0;
    for (int attempt = 0; attempt < attempts && heard < slices; ++attempt) {
        LcmBus receiver;
        LcmBus sender;
        heard = 0;
        bool ended = false;
        receiver.subscribe("SLICES", Delivery::every, [&](auto) { ++heard; });
        receiver.subscribe("END", Delivery::every, [&](auto) { ended = true; });
        receiver.dispatch(0ms);
        const std::vector<std::uint8_t> slice(8000, 7);
        for (int i = 0; i < slices; ++i) {
            sender.publish("SLICES", slice);
            // What LCM's own thread needs to empty a stock socket buffer; nobody dispatches meanwhile.
            usleep(200);
        }
        for (int i = 0; i < 50 && !ended; ++i) {
            sender.publish("END", {});
            receiver.dispatch(100ms);
        }
    }
    EXPECT_EQ(heard, slices);
}

TEST(LcmBus, AFloodDoesNotKeepDispatchFromReturning) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    LcmBus receiver;
    std::atomic<bool> stop{false};
    std::thread flood([&] {
        LcmBus sender;
        while (!stop) sender.publish("FLOOD", std::vector<std::uint8_t>(100));
    });
    std::int64_t heard = 0;
    receiver.subscribe("FLOOD", Delivery::every, [&](auto) {
        ++heard;
        usleep(1000);
    });
    for (int i = 0; i < 5; ++i) {
        const std::int64_t before = heard;
        EXPECT_TRUE(dispatch_until(receiver, [&] { return heard > before; }));
        EXPECT_LE(heard - before, 1000);
    }
    stop = true;
    flood.join();
}

volatile sig_atomic_t signals_seen = 0;

TEST(LcmBus, ASignalEndsTheWait) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    LcmBus bus;
    bus.subscribe("NOTHING", Delivery::every, [](auto) {});
    struct sigaction action {};
    struct sigaction before {};
    action.sa_handler = [](int) { signals_seen = signals_seen + 1; };
    sigaction(SIGUSR1, &action, &before);
    const pid_t self = getpid();
    std::atomic<bool> returned{false};
    std::thread sender([&] {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, nullptr);
        while (!returned) {  // sent to the process, as Ctrl-C is: LCM's thread must not take it
            kill(self, SIGUSR1);
            usleep(20'000);
        }
    });
    const auto start = Clock::now();
    EXPECT_FALSE(bus.dispatch(std::chrono::minutes(10)));
    returned = true;
    sender.join();
    sigaction(SIGUSR1, &before, nullptr);
    EXPECT_GE(signals_seen, 1);
    EXPECT_LT(Clock::now() - start, std::chrono::minutes(1));
}

TEST(LcmBus, AnExceptionInAHandlerLeavesDispatchAndTheBusGoesOn) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    LcmBus receiver;
    LcmBus sender;
    int heard = 0;
    receiver.subscribe("X", Delivery::every, [&](auto) {
        if (++heard == 1) throw std::runtime_error("first");
    });
    sender.publish("X", {});
    sender.publish("X", {});
    EXPECT_THROW(dispatch_until(receiver, [&] { return heard == 2; }), std::runtime_error);
    EXPECT_TRUE(dispatch_until(receiver, [&] { return heard == 2; }));
}

TEST(LcmBus, WhoHearsAllHearsEachChannelInItsOrder) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    LcmBus receiver;
    LcmBus sender;
    using Heard = std::vector<std::pair<std::string, std::uint8_t>>;
    Heard heard;
    Heard on_one;
    receiver.subscribe_all(
        [&](const std::string& channel, auto bytes) { heard.emplace_back(channel, bytes[0]); });
    receiver.subscribe("A", Delivery::every, [&](auto bytes) { on_one.emplace_back("A", bytes[0]); });
    Heard sent;
    for (std::uint8_t i = 0; i < 100; ++i) {
        sent.emplace_back(i % 3 == 0 ? "A" : "B.*", i);
        sender.publish(sent.back().first, std::vector<std::uint8_t>{i});
    }
    EXPECT_TRUE(dispatch_until(receiver, [&] { return heard.size() >= 100; }));
    EXPECT_EQ(heard, sent);
    EXPECT_EQ(on_one.size(), 34U);
}

/// Sends whatever bytes to LCM's default group and port.
class RawSender {
  public:
    RawSender() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        group_.sin_family = AF_INET;
        group_.sin_port = htons(7667);
        inet_pton(AF_INET, "239.255.76.67", &group_.sin_addr);
    }
    ~RawSender() { close(fd_); }
    void send(const std::vector<std::uint8_t>& bytes) {
        ASSERT_EQ(sendto(fd_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group_),
                         sizeof group_),
                  static_cast<ssize_t>(bytes.size()));
    }

  private:
    int fd_;
    sockaddr_in group_{};
};

std::vector<std::uint8_t> random_bytes(std::mt19937& random, std::size_t size) {
    std::vector<std::uint8_t> bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    return bytes;
}

TEST(LcmBus, GarbageOnThePortDisturbsNothing) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    LcmBus receiver;
    LcmBus sender;
    RawSender raw;
    std::mt19937 random(5);
    std::vector<std::int64_t> seqs;
    subscribe<posts_t>(receiver, "POSTS", [&](const posts_t& m) { seqs.push_back(m.seq); });
    subscribe<particles_t>(receiver, "PARTICLES",
                           [](const particles_t&) { FAIL() << "random bytes are no particles"; });
    const std::vector<std::uint8_t> particles = encoded(example_particles());

    auto posts = example_posts();
    std::int64_t on_channel = 0;
    for (posts.seq = 0; posts.seq < 50; ++posts.seq) {
        for (int i = 0; i < 4; ++i) {
            raw.send(random_bytes(random, 1 + random() % 400));
            // LCM's two magic words, then nonsense: a short message, a fragment.
            auto magic = random_bytes(random, 4 + random() % 200);
            const std::uint8_t word[] = {'L', 'C', '0', static_cast<std::uint8_t>(i % 2 == 0 ? '2' : '3')};
            std::copy(std::begin(word), std::end(word), magic.begin());
            raw.send(magic);
            // Real LCM packets on the channels we listen to: random payload, and random payload behind the
            // right hash.
            sender.publish("POSTS", random_bytes(random, random() % 300));
            auto forged = random_bytes(random, 8 + random() % 300);
            std::copy_n(particles.begin(), 8, forged.begin());
            sender.publish("PARTICLES", forged);
            on_channel += 2;
        }
        publish(sender, "POSTS", posts);
        ASSERT_TRUE(
            dispatch_until(receiver, [&] { return seqs.size() == static_cast<std::size_t>(posts.seq) + 1; }));
    }
    EXPECT_EQ(seqs.back(), 49);
    EXPECT_EQ(receiver.counters().rejected_total(), on_channel);
}

TEST(LcmBus, AWrongUrlIsAnErrorWithAnExample) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    for (const char* url : {"nonsense", "udpm//1", "nosuchprovider://x"}) {
        try {
            LcmBus bus(url);
            FAIL() << url;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(url), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("udpm://"), std::string::npos) << error.what();
        }
    }
}

TEST(LcmBus, ChannelNamesLcmCannotCarryAreRefused) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    LcmBus bus;
    EXPECT_THROW(bus.publish("", {}), std::invalid_argument);
    EXPECT_THROW(bus.publish(std::string(64, 'X'), {}), std::invalid_argument);
    EXPECT_THROW(bus.subscribe(std::string(64, 'X'), Delivery::every, [](auto) {}), std::invalid_argument);
}

TEST(LcmBus, SpeaksWithinAProcessWithoutANetwork) {
    LcmBus bus("memq://");
    int heard = 0;
    bus.subscribe("X", Delivery::every, [&](auto) { ++heard; });
    bus.publish("X", {});
    EXPECT_TRUE(dispatch_until(bus, [&] { return heard == 1; }));
}

TEST(LcmBus, WithoutSubscriptionsDispatchWaitsAndReturns) {
    LcmBus bus("memq://");
    EXPECT_FALSE(bus.dispatch(1ms));
}

TEST(Multicast, ThePortIsTheUrls) {
    EXPECT_EQ(udp_port("udpm://239.255.76.67:7669?ttl=0"), 7669);
    EXPECT_EQ(udp_port("udpm://"), 7667);
    EXPECT_EQ(udp_port("udpm://239.255.76.67"), 7667);
    EXPECT_EQ(udp_port("memq://"), 0);
    EXPECT_EQ(udp_port("file:///tmp/log?mode=r"), 0);
}

TEST(Multicast, AListenerThatDoesNotReadIsSeen) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    const int receiver = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const int sender = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(bind(receiver, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    socklen_t length = sizeof address;
    getsockname(receiver, reinterpret_cast<sockaddr*>(&address), &length);
    const int port = ntohs(address.sin_port);
    EXPECT_EQ(fullest_receive_buffer(port), 0.0);
    std::vector<std::uint8_t> bytes(30'000);
    for (int i = 0; i < 20; ++i) {
        sendto(sender, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address),
               sizeof address);
    }
    EXPECT_GT(fullest_receive_buffer(port), 0.5);
    while (recv(receiver, bytes.data(), bytes.size(), MSG_DONTWAIT) > 0) {
    }
    EXPECT_EQ(fullest_receive_buffer(port), 0.0);
    close(sender);
    close(receiver);
}

/// In a child process, because there is no way back: a network namespace without loopback or route.
TEST(Multicast, WithoutARouteTheErrorSaysWhatToType) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    EXPECT_TRUE(multicast_works());
    EXPECT_TRUE(multicast_works("udpm://239.255.76.68:7999?ttl=0"));
    EXPECT_FALSE(multicast_works("udpm://no.group:7667"));
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        int failures = 0;
        if (unshare(CLONE_NEWNET) != 0) _exit(100);
        const auto start = Clock::now();
        if (multicast_works()) failures |= 1;
        if (!multicast_works("memq://")) failures |= 2;
        try {
            LcmBus bus;
            failures |= 4;
        } catch (const std::runtime_error& error) {
            if (std::string(error.what()).find("ip route add") == std::string::npos) failures |= 8;
        }
        if (Clock::now() - start > 5s) failures |= 16;
        _exit(failures);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 100) GTEST_SKIP() << "skipped: no second network namespace";
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace goalmouth
