#include "core/messaging/frame_ring.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <sys/file.h>
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
    const auto [slot, memory] = ring.begin_write(size);
    std::fill(memory.begin(), memory.end(), value);
    return ring.finish_write(slot);
}

std::string read_maps() {
    std::ifstream maps("/proc/self/maps");
    return {std::istreambuf_iterator<char>(maps), {}};
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
        const auto [slot, memory] = ring.begin_write(5000);
        EXPECT_EQ(memory.size(), 5000U);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.data()) % 4096, 0U);
        ring.finish_write(slot);
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
    const int slot = ring.begin_write(100).slot;
    EXPECT_FALSE(frame->still_valid());
    EXPECT_FALSE(reader.try_open(first).has_value());
    EXPECT_EQ(reader.failure(), RingFailure::overwritten);
    ring.finish_write(slot);
    EXPECT_FALSE(frame->still_valid());
}

TEST(FrameRing, SeveralSlotsMayBeWrittenAtOnceAndFinishInAnyOrder) {
    FrameRing ring("front", 5, 100);
    RingReader reader;
    std::vector<FrameRing::OpenSlot> open;
    for (int i = 0; i < 3; ++i) open.push_back(ring.begin_write(100));
    EXPECT_EQ(ring.open_slots(), 3);
    std::set<std::int64_t> generations;
    for (const int i : {1, 2, 0}) {
        const auto& [slot, memory] = open[static_cast<std::size_t>(i)];
        std::fill(memory.begin(), memory.end(), static_cast<std::uint8_t>(10 + i));
        const RingPlace place = ring.finish_write(slot);
        EXPECT_EQ(place.slot, slot);
        EXPECT_TRUE(generations.insert(place.generation).second);
        const auto frame = reader.try_open(descriptor_of(ring, place, 100));
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->bytes()[99], 10 + i);
    }
    EXPECT_EQ(ring.open_slots(), 0);
    EXPECT_THROW(ring.finish_write(open[0].slot), std::logic_error);
    for (int i = 0; i < 5; ++i) ring.begin_write(100);
    EXPECT_THROW(ring.begin_write(100), std::logic_error);
}

// The contract that consumers rely on: slots − those being written.
TEST(FrameRing, AFrameStaysReadableUntilSoManyMoreAreFinished) {
    for (const int writing : {1, 2, 4}) {
        FrameRing ring("front", 8, 100);
        RingReader reader;
        std::deque<int> open;
        const auto begin = [&] { open.push_back(ring.begin_write(100).slot); };
        for (int i = 0; i < writing; ++i) begin();
        std::vector<image_t> frames;
        for (std::size_t k = 0; k < 30; ++k) {
            frames.push_back(descriptor_of(ring, ring.finish_write(open.front()), 100));
            open.pop_front();
            begin();
            const auto readable = static_cast<std::size_t>(8 - writing);
            for (std::size_t i = 0; i <= k; ++i)
                EXPECT_EQ(reader.try_open(frames[i]).has_value(), k - i < readable)
                    << writing << " " << k << " " << i;
        }
    }
}

TEST(FrameRing, AnAbandonedSlotIsReadByNobodyAndUsedNext) {
    FrameRing ring("front", 3, 100);
    RingReader reader;
    const RingPlace first = write_pattern(ring, 100, 1);
    const RingPlace second = write_pattern(ring, 100, 2);
    const int slot = ring.begin_write(100).slot;
    ring.abandon(slot);
    EXPECT_EQ(ring.open_slots(), 0);
    for (std::int64_t generation = 2; generation <= 8; generation += 2)
        EXPECT_FALSE(reader.try_open(descriptor_of(ring, {slot, generation}, 100)).has_value());
    const RingPlace third = write_pattern(ring, 100, 3);
    EXPECT_EQ(third.slot, slot);
    for (const RingPlace place : {first, second, third})
        EXPECT_TRUE(reader.try_open(descriptor_of(ring, place, 100)).has_value());
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
        EXPECT_EQ(flock(fd, LOCK_EX | LOCK_NB), 0) << "or another test removes it as stale";
        EXPECT_EQ(write(fd, contents.data(), contents.size()), static_cast<ssize_t>(contents.size()));
        RingReader reader;
        image_t m = good;
        m.ring = name;
        const bool opened = reader.try_open(m).has_value();
        shm_unlink(name.c_str());
        close(fd);
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

TEST(FrameRing, AReaderLetsGoOfRingsThatAreNoMoreWhenItMeetsAnother) {
    const auto mapped = [](const std::string& ring) {
        const std::string maps = read_maps();
        return maps.find(ring) != std::string::npos;
    };
    RingReader reader;
    std::string first_name;
    image_t last;
    {
        FrameRing first("front", 2, 100);
        first_name = first.name();
        last = descriptor_of(first, write_pattern(first, 100, 1), 100);
        EXPECT_TRUE(reader.try_open(last));
    }
    EXPECT_TRUE(reader.try_open(last)) << "what its producer sent before it ended can still be read";
    EXPECT_TRUE(mapped(first_name));
    last.ring = "/goalmouth-none";
    EXPECT_FALSE(reader.try_open(last));
    EXPECT_EQ(reader.failure(), RingFailure::gone);
    EXPECT_FALSE(mapped(first_name)) << "its memory would still count against /dev/shm";
}

TEST(FrameRing, TheRingOfAKilledProducerIsRemovedThoughItsProcessNumberIsInUseAgain) {
    const std::string name =
        "/goalmouth-" + std::to_string(getuid()) + "-" + std::to_string(getpid()) + "-old-1";
    const int fd = shm_open(name.c_str(), O_RDWR | O_CREAT, 0600);
    ASSERT_GE(fd, 0);
    close(fd);
    remove_stale_rings();
    EXPECT_FALSE(exists(name));
}

TEST(FrameRing, SizesThatMakeNoSenseAreRefused) {
    EXPECT_THROW(FrameRing("front", 1, 100), std::invalid_argument);
    EXPECT_THROW(FrameRing("front", 65, 100), std::invalid_argument);
    EXPECT_THROW(FrameRing("front", 4, 0), std::invalid_argument);
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
