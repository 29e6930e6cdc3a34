#include "core/messaging/frame_ring.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

image_t descriptor_of(const FrameRing& ring, RingPlace place, std::size_t size) {
    image_t m{};
    m.ring = ring.name();
    m.slot = place.slot;
    m.generation = place.generation;
    m.size = static_cast<std::int32_t>(size);
    return m;
}

RingPlace write_pattern(FrameRing& ring, std::size_t size, std::uint8_t value) {
    const auto memory = ring.begin_write(size);
    std::fill(memory.begin(), memory.end(), value);
    return ring.finish_write();
}

bool exists(const std::string& ring) {
    struct stat status {};
    return stat(("/dev/shm" + ring).c_str(), &status) == 0;
}

TEST(FrameRing, AReaderSeesTheFrameInPlace) {
    FrameRing ring("front", 4, 1000);
    RingReader reader;
    for (int i = 0; i < 20; ++i) {
        const auto value = static_cast<std::uint8_t>(i + 1);
        const auto frame = reader.try_open(descriptor_of(ring, write_pattern(ring, 1000, value), 1000));
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->bytes().size(), 1000U);
        EXPECT_TRUE(
            std::all_of(frame->bytes().begin(), frame->bytes().end(), [&](auto b) { return b == value; }));
        EXPECT_TRUE(frame->still_valid());
    }
}

TEST(FrameRing, SlotsArePages) {
    FrameRing ring("front", 3, 5000);
    EXPECT_EQ(ring.slot_bytes(), 8192U);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(ring.begin_write(5000).data()) % 4096, 0U);
        ring.finish_write();
    }
    EXPECT_THROW(ring.begin_write(8193), std::invalid_argument);
}

TEST(FrameRing, AFrameIsInvalidOnceItsSlotIsWrittenAgain) {
    FrameRing ring("front", 2, 100);
    RingReader reader;
    const image_t first = descriptor_of(ring, write_pattern(ring, 100, 1), 100);
    const auto frame = reader.try_open(first);
    ASSERT_TRUE(frame.has_value());
    write_pattern(ring, 100, 2);
    EXPECT_TRUE(frame->still_valid());
    ring.begin_write(100);
    EXPECT_FALSE(frame->still_valid());
    EXPECT_FALSE(reader.try_open(first).has_value());
    EXPECT_EQ(reader.failure(), RingFailure::overwritten);
    ring.finish_write();
    EXPECT_FALSE(frame->still_valid());
}

TEST(FrameRing, AFrameThatIsNotFinishedCannotBeOpened) {
    FrameRing ring("front", 2, 100);
    RingReader reader;
    const RingPlace place = write_pattern(ring, 100, 1);
    ring.begin_write(100);
    for (std::int64_t generation = -1; generation < 6; ++generation) {
        auto next = descriptor_of(ring, {1, generation}, 100);
        EXPECT_FALSE(reader.try_open(next).has_value()) << generation;
    }
    EXPECT_TRUE(reader.try_open(descriptor_of(ring, place, 100)).has_value());
}

TEST(FrameRing, AbsurdDescriptorsAreRefused) {
    FrameRing ring("front", 2, 100);
    RingReader reader;
    const image_t good = descriptor_of(ring, write_pattern(ring, 100, 1), 100);
    ASSERT_TRUE(reader.try_open(good).has_value());
    const auto expect_refused = [&](auto change) {
        image_t bad = good;
        change(bad);
        EXPECT_FALSE(reader.try_open(bad).has_value());
        EXPECT_EQ(reader.failure(), RingFailure::refused);
    };
    expect_refused([](image_t& m) { m.slot = 2; });
    expect_refused([](image_t& m) { m.slot = -1; });
    expect_refused([](image_t& m) { m.slot = 1 << 30; });
    expect_refused([](image_t& m) { m.size = 4097; });
    expect_refused([](image_t& m) { m.size = -1; });
    expect_refused([](image_t& m) { m.size = std::numeric_limits<int>::max(); });
    expect_refused([](image_t& m) { m.generation = 0; });
    expect_refused([](image_t& m) { m.generation = -2; });
    expect_refused([](image_t& m) { m.generation = 3; });
    expect_refused([](image_t& m) { m.ring = "/etc/passwd"; });
    expect_refused([](image_t& m) { m.ring = "/goalmouth-/../../etc/passwd"; });
    expect_refused([](image_t& m) { m.ring = "goalmouth-0-1-a-1"; });
    expect_refused([](image_t& m) { m.ring = "/goalmouth-" + std::string(300, 'x'); });
    expect_refused([](image_t& m) { m.ring.clear(); });
    image_t gone = good;
    gone.ring = "/goalmouth-0-1-nobody-1";
    EXPECT_FALSE(reader.try_open(gone).has_value());
    EXPECT_EQ(reader.failure(), RingFailure::gone);
    EXPECT_TRUE(reader.try_open(good).has_value());
}

TEST(FrameRing, SharedMemoryThatIsNoRingIsRefused) {
    FrameRing model("model", 2, 100);
    const image_t good = descriptor_of(model, write_pattern(model, 100, 1), 100);
    const int model_fd = shm_open(model.name().c_str(), O_RDONLY, 0);
    ASSERT_GE(model_fd, 0);
    std::vector<std::uint8_t> bytes(100'000);
    bytes.resize(static_cast<std::size_t>(read(model_fd, bytes.data(), bytes.size())));
    close(model_fd);

    const std::string name =
        "/goalmouth-" + std::to_string(getuid()) + "-" + std::to_string(getpid()) + "-forged-1";
    const auto opens = [&](const std::vector<std::uint8_t>& contents) {
        const int fd = shm_open(name.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
        EXPECT_EQ(write(fd, contents.data(), contents.size()), static_cast<ssize_t>(contents.size()));
        close(fd);
        RingReader reader;
        image_t m = good;
        m.ring = name;
        const bool opened = reader.try_open(m).has_value();
        shm_unlink(name.c_str());
        return opened;
    };
    EXPECT_TRUE(opens(bytes));
    EXPECT_FALSE(opens({}));
    EXPECT_FALSE(opens(std::vector<std::uint8_t>(20'000, 0)));
    EXPECT_FALSE(opens(std::vector<std::uint8_t>(20'000, 0xff)));
    for (const std::size_t size : {std::size_t{8}, std::size_t{4096}, bytes.size() - 1}) {
        EXPECT_FALSE(opens({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    }
    for (std::size_t at = 0; at < 32; ++at) {  // magic, version, slots, slot size, start of the data
        auto forged = bytes;
        forged[at] = static_cast<std::uint8_t>(forged[at] ^ 0x80);
        EXPECT_FALSE(opens(forged)) << at;
    }
}

TEST(FrameRing, OnlyItsUserMayOpenItAndItGoesWithItsProducer) {
    std::string name;
    {
        const FrameRing ring("front left/1", 2, 100);
        name = ring.name();
        struct stat status {};
        ASSERT_EQ(stat(("/dev/shm" + name).c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 0777, 0600U);
        EXPECT_TRUE(name.starts_with("/goalmouth-" + std::to_string(getuid()) + "-" +
                                     std::to_string(getpid()) + "-front_left_1-"));
    }
    EXPECT_FALSE(exists(name));
}

TEST(FrameRing, AReaderOutlivesItsProducer) {
    RingReader reader;
    std::optional<RingFrame> frame;
    {
        FrameRing ring("front", 2, 100);
        frame = reader.try_open(descriptor_of(ring, write_pattern(ring, 100, 42), 100));
    }
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->bytes()[99], 42);
    EXPECT_TRUE(frame->still_valid());
}

TEST(FrameRing, AFullSharedMemoryIsAnErrorNotACrash) {
    try {
        const FrameRing ring("front", 64, std::size_t{1} << 30);
        GTEST_SKIP() << "skipped: this machine has 64 GiB of shared memory";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("/dev/shm"), std::string::npos) << error.what();
    }
    EXPECT_THROW(FrameRing("front", 1, 100), std::invalid_argument);
    EXPECT_THROW(FrameRing("front", 65, 100), std::invalid_argument);
    EXPECT_THROW(FrameRing("front", 4, 0), std::invalid_argument);
}

// A producer far too fast for its readers. The readers may miss every frame, but must never believe one that
// mixes two.
TEST(FrameRing, ReadersNeverAcceptATornFrame) {
    constexpr std::size_t size = 64 * 1024;
    FrameRing ring("front", 2, size);
    std::atomic<std::int64_t> newest{0};
    std::atomic<bool> stop{false};
    std::atomic<std::int64_t> accepted{0};
    std::atomic<std::int64_t> refused{0};
    std::atomic<std::int64_t> torn{0};
    std::thread reader_thread([&] {
        RingReader reader;
        std::vector<std::uint64_t> copy(size / 8);
        while (!stop) {
            const std::int64_t generation = newest;
            if (generation == 0) continue;
            const auto slot = static_cast<std::int32_t>((generation / 2 - 1) % 2);
            const auto frame = reader.try_open(descriptor_of(ring, {slot, generation}, size));
            if (!frame) {
                ++refused;
                continue;
            }
            std::memcpy(copy.data(), frame->bytes().data(), size);
            if (!frame->still_valid()) {
                ++refused;
                continue;
            }
            ++accepted;
            const auto expected = static_cast<std::uint64_t>(generation);
            if (!std::all_of(copy.begin(), copy.end(), [&](auto word) { return word == expected; })) ++torn;
        }
    });
    std::vector<std::uint64_t> pattern(size / 8);
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    for (std::int64_t frame = 1; std::chrono::steady_clock::now() < limit; ++frame) {
        if (frame > 5000 && accepted > 100 && refused > 100) break;
        std::fill(pattern.begin(), pattern.end(), static_cast<std::uint64_t>(2 * frame));
        std::memcpy(ring.begin_write(size).data(), pattern.data(), size);
        newest = ring.finish_write().generation;
        if (frame % 4 == 0) std::this_thread::yield();
    }
    stop = true;
    reader_thread.join();
    EXPECT_EQ(torn, 0);
    EXPECT_GT(accepted, 0);
    EXPECT_GT(refused, 0);
}

TEST(FrameRing, TheRingOfAKilledProducerIsRemovedByTheNext) {
    int pipe_ends[2];
    ASSERT_EQ(pipe(pipe_ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        FrameRing ring("crash", 2, 100);
        const std::string name = ring.name();
        [[maybe_unused]] const auto written = write(pipe_ends[1], name.data(), name.size());
        close(pipe_ends[1]);
        for (;;) pause();
    }
    close(pipe_ends[1]);
    char buffer[300];
    const ssize_t size = read(pipe_ends[0], buffer, sizeof buffer);
    close(pipe_ends[0]);
    ASSERT_GT(size, 0);
    const std::string name(buffer, static_cast<std::size_t>(size));
    EXPECT_TRUE(exists(name));
    remove_stale_rings();
    EXPECT_TRUE(exists(name)) << "its producer lives";
    kill(child, SIGKILL);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    EXPECT_TRUE(exists(name));
    const FrameRing next("front", 2, 100);
    EXPECT_FALSE(exists(name));
    EXPECT_TRUE(exists(next.name()));
}

}  // namespace
}  // namespace goalmouth
