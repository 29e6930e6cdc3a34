#include "modules/tap/tap_module.h"

#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/log_file.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/example_messages.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace {
std::atomic<std::time_t> wall_clock_set_by{0};  // s
}

/// The wall clock of this program, which a test may set: takes the place of the C library's.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
    const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
    if (result == 0 && clock == CLOCK_REALTIME) time->tv_sec += wall_clock_set_by;
    return result;
}

namespace goalmouth {
namespace {

using namespace goalmouth::test;

FrameInfo info_of(std::int64_t seq, int width, int height) {
    FrameInfo info;
    info.utime = 1'000'000 + 2'000 * seq;
    info.seq = seq;
    info.intrinsics = example_intrinsics(width, height);
    info.exposure_us = 4000;
    info.readout_us = 9000;
    return info;
}

YuyvImage noise(int width, int height, unsigned seed) {
    YuyvImage image(width, height);
    std::mt19937 random(seed);
    for (auto& byte : image.data) byte = static_cast<std::uint8_t>(100 + random() % 40);
    return image;
}

/// A camera, the tap, and a consumer that has no shared memory, as after replay.
struct Tap : testing::Test {
    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("tap"), status, "tap", 0, {{"IMAGE_TAP", "OTHER_TAP"}}};
    ImageOutput camera{hub.endpoint("camera"), channels::image, "front"};
    std::optional<TapModule> tap;
    struct Seen {
        std::int64_t utime;
        std::int64_t seq;
        YuyvImage pixels;
    };
    std::vector<Seen> seen;
    ImageInput consumer{
        hub.endpoint("consumer"), "", "OTHER_TAP", channels::image_slices, [this](const Frame& frame) {
            EXPECT_EQ(frame.exposure_us, 4000);
            EXPECT_EQ(frame.readout_us, 9000);
            EXPECT_EQ(frame.camera, "front");
            Seen s{frame.utime, frame.seq, YuyvImage(frame.pixels.width, frame.pixels.height)};
            std::copy_n(frame.pixels.data, s.pixels.data.size(), s.pixels.data.begin());
            seen.push_back(std::move(s));
        }};
    int images = 0;
    int slices = 0;

    void start(TapParameters parameters) {
        tap.emplace(context, parameters);
        subscribe<image_t>(hub.endpoint("listener"), "OTHER_TAP", [this](const image_t& m) {
            ++images;
            EXPECT_LE(static_cast<std::size_t>(m.getEncodedSize()), datagram_bytes);
        });
        subscribe<image_slice_t>(hub.endpoint("listener"), channels::image_slices,
                                 [this](const image_slice_t& m) {
                                     ++slices;
                                     EXPECT_LE(static_cast<std::size_t>(m.getEncodedSize()), datagram_bytes);
                                 });
    }
    void send(std::int64_t seq, const YuyvImage& image) {
        camera.publish(info_of(seq, image.width, image.height), image.view());
        hub.run_until_idle();
    }
    void finish() {
        while (tap->tick() < std::chrono::seconds(1)) {
        }
        hub.run_until_idle();
    }
};

TEST_F(Tap, RawFramesComeThroughExactlyInSlices) {
    start({.encoding = "raw", .slice_bytes = 32000});
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        send(seq, noise(640, 480, static_cast<unsigned>(seq)));
        finish();
    }
    ASSERT_EQ(seen.size(), 3U);
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        const auto& frame = seen[static_cast<std::size_t>(seq)];
        EXPECT_EQ(frame.seq, seq);
        EXPECT_EQ(frame.utime, 1'000'000 + 2'000 * seq);
        EXPECT_EQ(frame.pixels.data, noise(640, 480, static_cast<unsigned>(seq)).data);
    }
    EXPECT_EQ(images, 0);
    EXPECT_EQ(slices, 3 * 20);
    EXPECT_EQ(status.outputs(), 3);
    EXPECT_EQ(status.dropped_frames(), 0);
}

TEST_F(Tap, ASmallRawFrameIsOneMessage) {
    start({.encoding = "raw"});
    send(0, noise(64, 48, 1));
    finish();
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].pixels.data, noise(64, 48, 1).data);
    EXPECT_EQ(images, 1);
    EXPECT_EQ(slices, 0);
}

TEST_F(Tap, JpegsFitADatagram) {
    start({.encoding = "jpeg", .jpeg_quality = 95});
    send(0, noise(640, 480, 1));
    finish();
    EXPECT_EQ(images, 1);
    EXPECT_EQ(slices, 0);
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].pixels.width, 640);
    EXPECT_EQ(status.outputs(), 1);
}

TEST_F(Tap, OnlyFramesItsIntervalDividesAreSent) {
    start({.encoding = "raw", .every = 3});
    for (std::int64_t seq = 0; seq < 10; ++seq) send(seq, noise(64, 48, 1));
    finish();
    std::vector<std::int64_t> seqs;
    for (const auto& frame : seen) seqs.push_back(frame.seq);
    EXPECT_EQ(seqs, (std::vector<std::int64_t>{0, 3, 6, 9}));
    EXPECT_EQ(status.dropped_frames(), 0);
}

TEST_F(Tap, FramesThatPileUpAreDroppedAndCounted) {
    start({.encoding = "raw"});
    for (std::int64_t seq = 0; seq < 12; ++seq) send(seq, noise(640, 480, 1));
    finish();
    EXPECT_EQ(seen.size(), 9U);
    EXPECT_EQ(status.dropped_frames(), 3);
}

TEST_F(Tap, GarbageOnTheImageChannelIsSkipped) {
    start({.encoding = "raw"});
    hub.endpoint("camera").publish(channels::image, std::vector<std::uint8_t>(300, 7));
    publish(hub.endpoint("camera"), channels::image, example_descriptor());
    send(0, noise(64, 48, 1));
    finish();
    EXPECT_EQ(seen.size(), 1U);
    EXPECT_EQ(hub.endpoint("tap").counters().rejected_total(), 1);
}

/// A tap between two networks: the graph's, and its own.
struct TapBetween : testing::Test {
    MemoryHub graph;
    MemoryHub own;
    Status status;
    std::vector<std::string> opened;
    ModuleContext context{graph.endpoint("tap"),
                          status,
                          "tap",
                          0,
                          {},
                          "udpm://239.255.76.67:7667?ttl=0",
                          [this](const std::string& url) {
                              opened.push_back(url);
                              return std::shared_ptr<Bus>(std::shared_ptr<Bus>{}, &own.endpoint("tap"));
                          }};
    ImageOutput camera{graph.endpoint("camera"), channels::image, "front"};
    using Heard = std::vector<std::pair<std::string, std::vector<std::uint8_t>>>;
    Heard on_graph;
    Heard on_own;
    std::optional<TapModule> tap;

    void start(const TapParameters& parameters) {
        tap.emplace(context, parameters);
        listen(graph, on_graph);
        listen(own, on_own);
    }
    static void listen(MemoryHub& hub, Heard& heard) {
        hub.endpoint("listener")
            .subscribe_all([&heard](const std::string& channel, std::span<const std::uint8_t> bytes) {
                heard.emplace_back(channel, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
            });
    }
    void say(const std::string& channel, std::uint8_t what) {
        graph.endpoint("somebody").publish(channel, std::vector<std::uint8_t>{what});
    }
    void send(std::int64_t seq) {
        const YuyvImage image = noise(64, 48, 1);
        camera.publish(info_of(seq, image.width, image.height), image.view());
    }
    void settle() {
        graph.run_until_idle();
        own.run_until_idle();
        while (tap->tick() < std::chrono::seconds(1)) {
        }
        own.run_until_idle();
    }
    static int count(const Heard& heard, const std::string& channel) {
        return static_cast<int>(std::count_if(heard.begin(), heard.end(),
                                              [&](const auto& message) { return message.first == channel; }));
    }
};

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

TEST_F(TapBetween, ItsOwnLogHoldsMessagesAndPicturesInTheOrderOfTime) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.lcmlog";
    start({.url = "off", .file = file.string(), .encoding = "raw"});
    const YuyvImage image = noise(640, 480, 3);
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        camera.publish(info_of(seq, image.width, image.height), image.view());
        say("POSE", static_cast<std::uint8_t>(seq));
        settle();
    }
    tap.reset();
    EXPECT_TRUE(on_own.empty());
    MemoryHub player;
    std::vector<std::int64_t> seqs;
    const ImageInput input(
        player.endpoint("reader"), "", "IMAGE_TAP", "IMAGE_SLICES", [&](const Frame& frame) {
            seqs.push_back(frame.seq);
            EXPECT_TRUE(std::equal(image.data.begin(), image.data.end(), frame.pixels.data));
        });
    std::int64_t last = 0;
    std::map<std::string, int> count;
    for (const LogEvent& event : read_log(file)) {
        EXPECT_GE(event.utime, last);
        last = event.utime;
        ++count[event.channel];
        player.endpoint("log").publish(event.channel, event.data);
    }
    player.run_until_idle();
    EXPECT_EQ(seqs, (std::vector<std::int64_t>{0, 1, 2}));
    EXPECT_EQ(count, (std::map<std::string, int>{{"IMAGE", 3}, {"IMAGE_SLICES", 60}, {"POSE", 3}}));
}

TEST_F(TapBetween, OnTheGraphsPortItsLogHoldsEachPictureOnce) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.lcmlog";
    start({.url = "graph", .file = file.string(), .encoding = "raw"});
    send(0);
    settle();
    graph.run_until_idle();
    tap.reset();
    int pictures = 0;
    for (const LogEvent& event : read_log(file)) pictures += event.channel == "IMAGE_TAP" ? 1 : 0;
    EXPECT_EQ(pictures, 1);
    EXPECT_EQ(count(on_graph, "IMAGE_TAP"), 1);
}

TEST_F(TapBetween, ALogOfAnEarlierLifeIsKept) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.lcmlog";
    for (int life = 0; life < 2; ++life) {
        tap.emplace(context, TapParameters{.file = file.string(), .encoding = "raw"});
        send(life);
        settle();
        tap.reset();
    }
    EXPECT_FALSE(read_log(file).empty());
    EXPECT_FALSE(read_log(file.string() + ".2").empty());
}

/// No file of this process grows beyond a size while it lives, as on a disk that is full.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) {
        former_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &former_);
        const rlimit limit{bytes, former_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &former_);
        std::signal(SIGXFSZ, former_handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit former_{};
    void (*former_handler_)(int) = nullptr;
};

TEST_F(TapBetween, OnAFullDiskTheLogStaysReadableAndTheTapGoesOn) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.lcmlog";
    start({.file = file.string(), .encoding = "raw"});
    {
        const FullDisk full(100'000);
        for (std::int64_t seq = 0; seq < 20; ++seq) {
            send(seq);
            say("POSE", static_cast<std::uint8_t>(seq));
            settle();
        }
    }
    EXPECT_EQ(count(on_own, "IMAGE_TAP"), 20);
    EXPECT_EQ(count(on_own, "POSE"), 20);
    EXPECT_GE(status.counters().at("not_recorded"), 1.0);
    say("POSE", 77);  // there is room again
    settle();
    tap.reset();
    LogReader reader(file);
    int pictures = 0;
    std::vector<std::uint8_t> last;
    while (const auto event = reader.next()) {
        pictures += event->channel == "IMAGE_TAP" ? 1 : 0;
        last = event->data;
    }
    EXPECT_EQ(reader.damaged_stretches(), 0);
    EXPECT_GE(pictures, 10);
    EXPECT_LT(pictures, 20);
    EXPECT_EQ(last, std::vector<std::uint8_t>{77});
}

TEST_F(TapBetween, AWallClockSetBackHoldsNoPictureUpInItsLog) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.lcmlog";
    start({.url = "off", .file = file.string(), .encoding = "raw"});
    const YuyvImage image = noise(640, 480, 3);
    constexpr int frames = 12;  // more than wait at most
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    for (int seq = 0; seq < frames; ++seq) {
        camera.publish(info_of(seq, image.width, image.height), image.view());
        say("POSE", static_cast<std::uint8_t>(seq));
        graph.run_until_idle();
        if (seq == 3) wall_clock_set_by = -3600;
        const std::size_t whole = static_cast<std::size_t>(seq + 1) * image.data.size();
        while (std::filesystem::file_size(file) < whole && std::chrono::steady_clock::now() < limit)
            tap->tick();
        EXPECT_GE(std::filesystem::file_size(file), whole) << "picture " << seq;
    }
    tap.reset();
    wall_clock_set_by = 0;
    std::int64_t last = 0;
    int slices = 0;
    for (const LogEvent& event : read_log(file)) {
        EXPECT_GE(event.utime, last);
        last = event.utime;
        slices += event.channel == "IMAGE_SLICES" ? 1 : 0;
    }
    EXPECT_EQ(slices, 20 * frames);
    EXPECT_EQ(status.dropped_frames(), 0);
}

TEST_F(TapBetween, FramesForWhichItsLogHasNoTimeAreDroppedAndCounted) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.lcmlog";
    start({.url = "off", .file = file.string(), .encoding = "raw"});
    const YuyvImage image = noise(640, 480, 3);
    int sent = 0;
    for (; status.dropped_frames() == 0 && sent < 200; ++sent) {
        FrameInfo info = info_of(sent, image.width, image.height);
        info.utime = 1'000'000 + 200'000 * sent;  // so much time to write each, and they come at once
        camera.publish(info, image.view());
        graph.run_until_idle();
        tap->tick();
    }
    const auto dropped = static_cast<int>(status.dropped_frames());
    EXPECT_GT(dropped, 0);
    EXPECT_EQ(status.counters().at("frames_not_recorded"), dropped);
    EXPECT_EQ(status.counters().at("recorded_frames"), sent - dropped);
    tap.reset();
    int slices = 0;
    for (const LogEvent& event : read_log(file)) slices += event.channel == "IMAGE_SLICES" ? 1 : 0;
    EXPECT_EQ(slices, 20 * (sent - dropped));
}

TEST_F(TapBetween, MessagesMissingInItsLogAreCountedWithoutAPictureToo) {
    const TemporaryFolder folder;
    start({.file = (folder.path() / "run.lcmlog").string()});
    {
        const FullDisk full(10);
        say("POSE", 1);
        say("POSE", 2);
        settle();
    }
    EXPECT_EQ(status.counters().at("not_recorded"), 2.0);
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

TEST(TapConfiguration, ListsEveryParameterWithItsDefault) {
    const auto loaded =
        load_parameters<TapParameters>(std::string(GOALMOUTH_SOURCE_DIR) + "/config/modules/tap.yaml");
    const auto in_file = list_parameters(loaded);
    const auto defaults = list_parameters<TapParameters>();
    ASSERT_EQ(in_file.size(), defaults.size());
    for (std::size_t i = 0; i < defaults.size(); ++i)
        EXPECT_EQ(in_file[i].value, defaults[i].value) << defaults[i].key;
    const auto file =
        Configuration::from_file(std::string(GOALMOUTH_SOURCE_DIR) + "/config/modules/tap.yaml");
    for (const auto& parameter : defaults) {
        if (parameter.key == "file") continue;  // none
        EXPECT_NE(file.text(parameter.key), "") << parameter.key;
    }
}

}  // namespace
}  // namespace goalmouth
