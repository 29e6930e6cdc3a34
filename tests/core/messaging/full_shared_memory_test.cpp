#include "core/messaging/channels.h"
#include "core/messaging/frame_ring.h"
#include "core/messaging/image_input.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "tests/support/example_messages.h"
#include "tests/support/small_shared_memory.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// With a /dev/shm of a few megabytes that is nobody else's.
namespace goalmouth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

#define GOALMOUTH_IN_SMALL_SHARED_MEMORY(megabytes, ...)                                              \
    if (const std::string why = test::with_small_shared_memory(megabytes, __VA_ARGS__); !why.empty()) \
    GTEST_SKIP() << "skipped: " << why

std::uintmax_t free_bytes() {
    return std::filesystem::space("/dev/shm").available;
}

/// A camera and a consumer of its frames.
struct Pair {
    MemoryHub hub;
    ImageOutput output{hub.endpoint("camera"), channels::image, "front", 4};
    std::vector<std::int64_t> seen;
    ImageInput input{hub.endpoint("consumer"), channels::image, "", "", [this](const Frame& frame) {
                         EXPECT_EQ(*frame.pixels.data, static_cast<std::uint8_t>(frame.seq));
                         EXPECT_TRUE(frame.still_valid());
                         seen.push_back(frame.seq);
                     }};

    bool send(std::int64_t seq, int width = 640, int height = 480) {
        FrameInfo info;
        info.utime = 1'000'000 + 33'333 * seq;
        info.seq = seq;
        info.intrinsics = test::example_intrinsics(width, height);
        YuyvImage image(width, height);
        image.data[0] = static_cast<std::uint8_t>(seq);
        const bool sent = output.publish(info, image.view());
        hub.run_until_idle();
        return sent;
    }
};

TEST(FullSharedMemory, ARingThatDoesNotFitSaysWhatToDoAndTakesNothing) {
    GOALMOUTH_IN_SMALL_SHARED_MEMORY(4, [] {
        const auto before = free_bytes();
        try {
            const FrameRing ring("front", 4, 2'000'000);
            ADD_FAILURE() << "8 MB in 4 MB";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr("4 frames of 2000000 bytes (9 MB)"));
            EXPECT_THAT(error.what(), HasSubstr("only 4 MB are left"));
            EXPECT_THAT(error.what(), HasSubstr("make room in /dev/shm"));
        }
        EXPECT_EQ(free_bytes(), before);
        EXPECT_TRUE(std::filesystem::is_empty("/dev/shm"));
    });
}

// A hole in a full file system would show as a SIGBUS of whoever writes there first.
TEST(FullSharedMemory, ARingThatFitsIsAllocatedWhole) {
    GOALMOUTH_IN_SMALL_SHARED_MEMORY(8, [] {
        FrameRing ring("front", 4, 1'000'000);
        std::ofstream("/dev/shm/others") << std::string(8'000'000, 'x');
        EXPECT_EQ(free_bytes(), 0U);
        for (int i = 0; i < 8; ++i) {
            const auto [slot, memory] = ring.begin_write(1'000'000);
            std::fill(memory.begin(), memory.end(), std::uint8_t{1});
            ring.finish_write(slot);
        }
    });
}

TEST(FullSharedMemory, ACameraGoesOnAndSendsOnceThereIsRoom) {
    GOALMOUTH_IN_SMALL_SHARED_MEMORY(1, [] {
        Pair pair;
        for (std::int64_t seq = 0; seq < 5; ++seq) EXPECT_FALSE(pair.send(seq));
        EXPECT_EQ(pair.output.missed_frames(), 5);
        EXPECT_FALSE(pair.output.open(1000'000));
        EXPECT_EQ(pair.input.frame_gone(), 5) << "consumers know that there were frames";
        test::resize_shared_memory(8);
        for (std::int64_t seq = 5; seq < 8; ++seq) EXPECT_TRUE(pair.send(seq));
        EXPECT_THAT(pair.seen, ElementsAre(5, 6, 7));
        EXPECT_EQ(pair.output.missed_frames(), 5);
        EXPECT_EQ(pair.output.copied_frames(), 3);
        EXPECT_EQ(pair.output.frames_in_place(), 0);
    });
}

TEST(FullSharedMemory, WhereALargerRingDoesNotFitTheOneThereIsStays) {
    GOALMOUTH_IN_SMALL_SHARED_MEMORY(8, [] {
        Pair pair;
        EXPECT_TRUE(pair.send(0));
        const std::string ring = pair.output.ring();
        EXPECT_FALSE(pair.send(1, 1600, 1200));
        EXPECT_EQ(pair.output.ring(), ring);
        EXPECT_TRUE(pair.send(2));
        EXPECT_EQ(pair.output.ring(), ring);
        test::resize_shared_memory(64);
        EXPECT_TRUE(pair.send(3, 1600, 1200));
        EXPECT_NE(pair.output.ring(), ring);
        EXPECT_THAT(pair.seen, ElementsAre(0, 2, 3));
    });
}

TEST(FullSharedMemory, OthersKeepWhatTheyHave) {
    GOALMOUTH_IN_SMALL_SHARED_MEMORY(4, [] {
        Pair first;
        EXPECT_TRUE(first.send(0));
        Pair second;
        for (std::int64_t seq = 0; seq < 10; ++seq) {
            EXPECT_FALSE(second.send(seq));
            EXPECT_TRUE(first.send(seq + 1));
        }
        EXPECT_EQ(first.seen.size(), 11U);
        EXPECT_TRUE(second.seen.empty());
    });
}

// A camera that died leaves a ring that its readers still have mapped: the memory is not free yet.
TEST(FullSharedMemory, ACameraStartedAnewGetsTheMemoryThatReadersOfTheOldOneStillHold) {
    GOALMOUTH_IN_SMALL_SHARED_MEMORY(4, [] {
        Pair pair;
        auto old =
            std::make_unique<ImageOutput>(pair.hub.endpoint("old camera"), channels::image, "front", 4);
        FrameInfo info;
        info.utime = 1'000'000;
        info.seq = 0;
        info.intrinsics = test::example_intrinsics(640, 480);
        EXPECT_TRUE(old->publish(info, YuyvImage(640, 480).view()));
        pair.hub.run_until_idle();
        EXPECT_THAT(pair.seen, ElementsAre(0));
        old.reset();
        EXPECT_LT(free_bytes(), 2'500'000U);
        EXPECT_FALSE(pair.send(1));
        EXPECT_TRUE(pair.send(2)) << "the frame before had them let go";
        EXPECT_THAT(pair.seen, ElementsAre(0, 2));
    });
}

}  // namespace
}  // namespace goalmouth
