// The log that the tap writes itself.

#include "core/messaging/image_output.h"
#include "core/messaging/log_file.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "tests/modules/tap/tap_fixture.h"
#include "tests/support/data.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
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

}  // namespace
}  // namespace goalmouth
