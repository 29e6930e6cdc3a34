#include "core/messaging/frame_ring.h"
#include "core/messaging/image_input.h"
#include "core/messaging/image_output.h"
#include "core/messaging/lcm_bus.h"
#include "tests/support/example_messages.h"
#include "tests/support/network.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

// The ring between processes that are too fast, too slow, or killed. The children are forked before anything
// here has threads, tell what they found in shared memory, and end with _exit or by force.
namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t frame_bytes = 1600 * 1200 * 2;
constexpr std::size_t frame_words = frame_bytes / 8;
constexpr int ring_slots = 6;
constexpr int open_slots = 3;
constexpr auto patience = std::chrono::seconds(60);

/// What the processes of a test share besides the ring: in place of the descriptors on a bus.
struct Board {
    struct Descriptor {  // a sequence lock too: even while whole
        std::atomic<std::uint64_t> version;
        char ring[256];
        RingPlace place;
        std::uint64_t pattern;
    };
    Descriptor newest;
    std::atomic<bool> stop;
    std::atomic<std::int64_t> written, accepted, refused, torn, gone;

    /// In memory that forked children share.
    static Board& make() {
        void* memory =
            mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        return *static_cast<Board*>(memory);  // zeros
    }
    void announce(const FrameRing& ring, RingPlace place, std::uint64_t pattern) {
        newest.version.fetch_add(1);
        std::strncpy(newest.ring, ring.name().c_str(), sizeof newest.ring - 1);
        newest.place = place;
        newest.pattern = pattern;
        newest.version.fetch_add(1);
        ++written;
    }
    /// The newest descriptor and its pattern, once there is one and it is whole.
    std::optional<std::pair<image_t, std::uint64_t>> look() const {
        const std::uint64_t version = newest.version;
        if (version == 0 || version % 2 != 0) return {};
        Descriptor copy;
        std::memcpy(copy.ring, newest.ring, sizeof copy.ring);
        copy.place = newest.place;
        copy.pattern = newest.pattern;
        std::atomic_thread_fence(std::memory_order_seq_cst);
        if (newest.version != version) return {};
        image_t m{};
        m.ring = copy.ring;
        m.slot = copy.place.slot;
        m.generation = copy.place.generation;
        m.size = static_cast<std::int32_t>(frame_bytes);
        return std::pair(m, copy.pattern);
    }
};

pid_t start(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that fails half-way leaves nobody behind
        work();
        _exit(0);
    }
    return child;
}

void kill_and_reap(pid_t child) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
}

bool wait_until(const std::function<bool()>& done) {
    const auto limit = Clock::now() + patience;
    while (!done() && Clock::now() < limit) usleep(500);
    return done();
}

/// As fast as it can, three slots open like those of a driver; each second frame is written by the kernel, as
/// a driver would. Every eight bytes of a frame hold its pattern.
void produce(Board& board, const char* camera, std::uint64_t first_pattern) {
    FrameRing ring(camera, ring_slots, frame_bytes);
    const int file = memfd_create("pattern", MFD_CLOEXEC);
    std::vector<std::uint64_t> words(frame_words);
    std::deque<FrameRing::OpenSlot> open;
    for (int i = 0; i < open_slots; ++i) open.push_back(ring.begin_write(frame_bytes));
    for (std::uint64_t pattern = first_pattern; !board.stop; ++pattern) {
        std::fill(words.begin(), words.end(), pattern);
        auto* to = open.front().bytes.data();
        if (pattern % 2 == 0) {
            std::memcpy(to, words.data(), frame_bytes);
        } else if (pwrite(file, words.data(), frame_bytes, 0) != static_cast<ssize_t>(frame_bytes) ||
                   pread(file, to, frame_bytes, 0) != static_cast<ssize_t>(frame_bytes)) {
            _exit(3);
        }
        board.announce(ring, ring.finish_write(open.front().slot), pattern);
        open.pop_front();
        open.push_back(ring.begin_write(frame_bytes));
    }
}

/// Reads the newest frame in place, in pieces, now and then so slowly that the producer comes round.
void consume(Board& board, unsigned seed) {
    RingReader reader;
    std::mt19937 random(seed);
    while (!board.stop) {
        const auto newest = board.look();
        if (!newest) continue;
        const auto& [descriptor, pattern] = *newest;
        const auto frame = reader.try_open(descriptor);
        if (!frame) {
            ++(reader.failure() == RingFailure::gone ? board.gone : board.refused);
            continue;
        }
        const std::int64_t wait_for = board.written + static_cast<std::int64_t>(random() % 5);
        const std::size_t pause_at = random() % frame_words;
        const bool dawdle = random() % 2 == 0;
        const auto* words = reinterpret_cast<const std::uint64_t*>(frame->bytes().data());
        std::size_t others = 0;
        for (std::size_t i = 0; i < frame_words; ++i) {
            if (dawdle && i == pause_at) {
                while (board.written < wait_for && !board.stop) usleep(50);
            }
            others += words[i] != pattern;
        }
        if (!frame->still_valid()) {
            ++board.refused;
        } else {
            ++board.accepted;
            if (others != 0) ++board.torn;
        }
    }
}

std::vector<std::string> rings_named(const std::string& camera) {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
        const std::string name = entry.path().filename().string();
        if (name.find("-" + camera + "-") != std::string::npos) found.push_back(name);
    }
    return found;
}

std::size_t mapped_rings() {
    std::ifstream maps("/proc/self/maps");
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    std::size_t count = 0;
    for (std::size_t at = text.find("/goalmouth-"); at != std::string::npos;
         at = text.find("/goalmouth-", at + 1))
        ++count;
    return count;
}

std::string unique_camera(const char* what) {
    return what + std::to_string(getpid());
}

// A producer far too fast for its readers. They may miss every frame, but must never believe one that mixes
// two.
TEST(FrameRingProcesses, ReadersNeverAcceptATornFrame) {
    Board& board = Board::make();
    const std::string camera = unique_camera("torn");
    std::vector<pid_t> children{start([&] { produce(board, camera.c_str(), 1); })};
    for (unsigned seed = 1; seed <= 3; ++seed) children.push_back(start([&, seed] { consume(board, seed); }));
    wait_until([&] { return board.written > 1500 && board.accepted > 200 && board.refused > 200; });
    board.stop = true;
    for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    std::printf("%ld frames of %zu bytes, %ld accepted, %ld refused\n", board.written.load(), frame_bytes,
                board.accepted.load(), board.refused.load());
    EXPECT_EQ(board.torn, 0);
    EXPECT_GT(board.accepted, 0);
    EXPECT_GT(board.refused, 0);
    EXPECT_EQ(board.gone, 0);
}

TEST(FrameRingProcesses, ProducersKilledWhileTheyWriteAreReplacedWithinOneFrame) {
    Board& board = Board::make();
    const std::string camera = unique_camera("killed");
    const pid_t other_reader = start([&] { consume(board, 1); });
    RingReader reader;
    std::mt19937 random(5);
    std::string old_ring;
    for (int round = 0; round < 25; ++round) {
        const std::int64_t before = board.written;
        const auto pattern = static_cast<std::uint64_t>(round + 1) << 32;
        const pid_t producer = start([&] { produce(board, camera.c_str(), pattern); });
        ASSERT_TRUE(wait_until([&] { return board.written > before; }));
        kill(producer, SIGSTOP);
        waitpid(producer, nullptr, WUNTRACED);
        const auto newest = board.look();
        if (newest) {  // unless it was stopped in the middle of announcing
            EXPECT_EQ(newest->second >> 32, static_cast<std::uint64_t>(round + 1));
            const auto frame = reader.try_open(newest->first);
            ASSERT_TRUE(frame) << "round " << round << ", failure " << static_cast<int>(reader.failure());
            std::uint64_t word = 0;
            std::memcpy(&word, frame->bytes().data() + frame_bytes - 8, 8);
            EXPECT_EQ(word, newest->second);
            EXPECT_TRUE(frame->still_valid());
            EXPECT_NE(newest->first.ring, old_ring);
            old_ring = newest->first.ring;
            EXPECT_EQ(rings_named(camera).size(), 1U) << "the dead one's is gone";
            EXPECT_EQ(mapped_rings(), 1U) << "here too";
        }
        kill(producer, SIGCONT);
        const std::int64_t until = board.written + static_cast<std::int64_t>(random() % 8);
        EXPECT_TRUE(wait_until([&] { return board.written >= until; }));
        usleep(static_cast<useconds_t>(random() % 2000));  // anywhere within a frame
        kill_and_reap(producer);
        if (board.newest.version % 2 != 0) ++board.newest.version;  // killed while announcing
    }
    kill_and_reap(other_reader);
    remove_stale_rings();
    EXPECT_TRUE(rings_named(camera).empty());
    EXPECT_GT(board.accepted, 0);
    EXPECT_EQ(board.torn, 0);
}

TEST(FrameRingProcesses, KilledReadersAreNotNoticed) {
    Board& board = Board::make();
    const std::string camera = unique_camera("readers");
    const pid_t producer = start([&] { produce(board, camera.c_str(), 1); });
    std::mt19937 random(6);
    for (int round = 0; round < 50; ++round) {
        const std::int64_t before = board.written;
        const std::int64_t used = board.accepted + board.refused;
        const pid_t reader = start([&] { consume(board, static_cast<unsigned>(round)); });
        EXPECT_TRUE(wait_until([&] { return board.accepted + board.refused > used; }));
        usleep(static_cast<useconds_t>(random() % 2000));
        kill_and_reap(reader);
        EXPECT_TRUE(wait_until([&] { return board.written > before + 2; })) << "the producer goes on";
    }
    EXPECT_EQ(waitpid(producer, nullptr, WNOHANG), 0);
    EXPECT_EQ(rings_named(camera).size(), 1U);
    board.stop = true;
    int status = -1;
    waitpid(producer, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(rings_named(camera).empty());
    EXPECT_EQ(board.torn, 0);
}

TEST(FrameRingProcesses, TwoProducersOfOneNameNeverMeet) {
    Board& left = Board::make();
    Board& right = Board::make();
    const std::string camera = unique_camera("twins");
    const pid_t left_producer = start([&] { produce(left, camera.c_str(), std::uint64_t{1} << 40); });
    const pid_t right_producer = start([&] { produce(right, camera.c_str(), std::uint64_t{1} << 41); });
    const pid_t left_reader = start([&] { consume(left, 1); });
    const pid_t right_reader = start([&] { consume(right, 2); });
    EXPECT_TRUE(wait_until([&] { return left.accepted > 30 && right.accepted > 30; }));
    EXPECT_EQ(rings_named(camera).size(), 2U);
    kill_and_reap(left_producer);
    remove_stale_rings();
    EXPECT_EQ(rings_named(camera).size(), 1U);
    const std::int64_t so_far = right.accepted;
    EXPECT_TRUE(wait_until([&] { return right.accepted > so_far + 30; }))
        << "its twin's end is nothing to it";
    for (const pid_t child : {right_producer, left_reader, right_reader}) kill_and_reap(child);
    remove_stale_rings();
    EXPECT_TRUE(rings_named(camera).empty());
    EXPECT_EQ(left.torn + right.torn, 0);
}

// Same user, same machine, same name of the camera: the port tells them apart, as with every message.
TEST(FrameRingProcesses, TwoRobotsOnDifferentPortsNeverMeet) {
    GOALMOUTH_NEEDS_PRIVATE_NETWORK();
    struct Robot {
        explicit Robot(const std::string& url, std::uint8_t pixel_value)
            : value(pixel_value),
              camera_bus(url),
              consumer_bus(url),
              camera(camera_bus, "IMAGE", "front"),
              consumer(consumer_bus, "IMAGE", "", "", [this](const Frame& frame) {
                  ++frames;
                  foreign += *frame.pixels.data != value;
              }) {}
        void send(std::int64_t seq) {
            FrameInfo info;
            info.utime = 1'000'000 + seq;
            info.seq = seq;
            info.intrinsics = test::example_intrinsics(64, 48);
            YuyvImage image(64, 48);
            std::fill(image.data.begin(), image.data.end(), value);
            camera.publish(info, image.view());
        }
        std::uint8_t value;
        LcmBus camera_bus, consumer_bus;
        int frames = 0, foreign = 0;
        ImageOutput camera;
        ImageInput consumer;
    };
    Robot red("udpm://239.255.76.67:7671?ttl=0", 1);
    Robot blue("udpm://239.255.76.67:7672?ttl=0", 2);
    std::int64_t seq = 0;
    EXPECT_TRUE(wait_until([&] {
        red.send(seq);
        blue.send(seq++);
        red.consumer_bus.dispatch(std::chrono::milliseconds(5));
        blue.consumer_bus.dispatch(std::chrono::milliseconds(5));
        return red.frames >= 50 && blue.frames >= 50;
    }));
    EXPECT_NE(red.camera.ring(), blue.camera.ring());
    EXPECT_EQ(red.foreign + blue.foreign, 0);
    EXPECT_LE(red.frames, seq);
    EXPECT_LE(blue.frames, seq);
}

}  // namespace
}  // namespace goalmouth
