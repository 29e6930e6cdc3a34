// Compressed images.

#include "core/imaging/jpeg.h"
#include "tests/core/messaging/image_io_fixture.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

RingPlace write_jpeg(FrameRing& ring, const std::vector<std::uint8_t>& jpeg) {
    const auto [slot, memory] = ring.begin_write(jpeg.size());
    std::copy(jpeg.begin(), jpeg.end(), memory.begin());
    return ring.finish_write(slot);
}

/// A descriptor as a foreign camera may send it: ours announce pixels only.
image_t compressed(const FrameInfo& info, const FrameRing& ring, RingPlace place, std::size_t bytes) {
    image_t m{};
    m.utime = info.utime;
    m.seq = info.seq;
    m.camera = "front";
    m.intrinsics = info.intrinsics;
    m.width = info.intrinsics.width;
    m.height = info.intrinsics.height;
    m.exposure_us = info.exposure_us;
    m.encoding = "jpeg";
    m.ring = ring.name();
    m.slot = place.slot;
    m.generation = place.generation;
    m.size = static_cast<std::int32_t>(bytes);
    return m;
}

TEST_F(ImageIo, JpegsAreDecodedInBothForms) {
    const YuyvImage image = picture(64, 48, 100);
    const auto jpeg = jpeg_from_yuyv(image.view(), 90);
    FrameRing ring("front", 2, jpeg.size());
    publish(sender, channels::image, compressed(info_of(0), ring, write_jpeg(ring, jpeg), jpeg.size()));
    hub.run_until_idle();
    publish(sender, channels::image_tap, self_contained_jpeg(info_of(100), "front", image.view(), 90, 60000));
    hub.run_until_idle();
    ASSERT_EQ(seqs(), (Seqs{0, 100}));
    for (const auto& frame : seen) EXPECT_EQ(frame.pixels, bytes_of(yuyv_from_jpeg(jpeg).view()));
}

TEST_F(ImageIo, AJpegOutOfARingStaysValidWhateverItsCameraWrites) {
    const auto jpeg = jpeg_from_yuyv(picture(64, 48, 100).view(), 90);
    FrameRing ring("front", 2, jpeg.size());
    int frames = 0;
    ImageInput consumer(receiver, channels::image, "", "", [&](const Frame& frame) {
        const auto before = bytes_of(frame.pixels);
        for (int i = 0; i < 4; ++i) write_jpeg(ring, std::vector<std::uint8_t>(jpeg.size(), 0));
        EXPECT_EQ(bytes_of(frame.pixels), before);
        EXPECT_TRUE(frame.still_valid());
        EXPECT_TRUE(frame.live);
        EXPECT_FALSE(frame.ring_frame) << "the pixels stand elsewhere";
        ++frames;
    });
    publish(sender, channels::image, compressed(info_of(0), ring, write_jpeg(ring, jpeg), jpeg.size()));
    hub.run_until_idle();
    EXPECT_EQ(frames, 1);
}

// Decoded in place, a JPEG would change under the decoder's eyes: half one image, half the other, or none.
TEST_F(ImageIo, AJpegThatIsOverwrittenWhileItIsReadIsNeverDecoded) {
    std::vector<std::vector<std::uint8_t>> jpegs, pixels;
    for (std::uint32_t seed = 0; seed < 2; ++seed) {
        YuyvImage noise(320, 240);
        std::mt19937 random(seed);
        for (auto& byte : noise.data) byte = static_cast<std::uint8_t>(random());
        jpegs.push_back(jpeg_from_yuyv(noise.view(), 90));
        pixels.push_back(yuyv_from_jpeg(jpegs.back()).data);
    }
    const std::size_t size = std::max(jpegs[0].size(), jpegs[1].size());
    for (auto& jpeg : jpegs) jpeg.resize(size, 0);  // cameras pad
    FrameRing ring("front", 3, size);  // an odd number: each slot holds one and the other in turn

    std::mutex mutex;
    RingPlace newest = write_jpeg(ring, jpegs[0]);
    std::atomic<bool> done = false;
    std::thread camera([&] {
        for (std::size_t i = 1; !done; ++i) {
            const RingPlace place = write_jpeg(ring, jpegs[i % 2]);
            const std::lock_guard lock(mutex);
            newest = place;
        }
    });
    int whole = 0, torn = 0;
    ImageInput consumer(receiver, channels::image, "", "", [&](const Frame& frame) {
        const auto seen_pixels = bytes_of(frame.pixels);
        ++(seen_pixels == pixels[0] || seen_pixels == pixels[1] ? whole : torn);
    });
    for (std::int64_t seq = 0; seq < 400; ++seq) {
        RingPlace place;
        {
            const std::lock_guard lock(mutex);
            place = newest;
        }
        publish(sender, channels::image, compressed(info_of(seq, 320, 240), ring, place, size));
        hub.run_until_idle();
    }
    done = true;
    camera.join();
    EXPECT_EQ(torn, 0);
    EXPECT_EQ(receiver.counters().rejected_total(), 0) << "what was whole in the ring decodes";
    EXPECT_EQ(whole + consumer.overwritten(), 400);
}

TEST_F(ImageIo, BrokenJpegsAreCountedAndSkipped) {
    auto message = self_contained_jpeg(info_of(0), "front", picture(64, 48, 100).view(), 90, 60000);
    message.data.resize(message.data.size() / 2);
    message.size = message.data_size = static_cast<std::int32_t>(message.data.size());
    publish(sender, channels::image_tap, message);
    message.data.assign(message.data.size(), 0x55);
    publish(sender, channels::image_tap, message);
    auto other_size = self_contained_jpeg(info_of(0), "front", picture(64, 48, 100).view(), 90, 60000);
    other_size.width = other_size.intrinsics.width = 63;
    publish(sender, channels::image_tap, other_size);
    hub.run_until_idle();
    EXPECT_TRUE(seen.empty());
    EXPECT_EQ(receiver.counters().rejected_total(), 3);
    send_whole(1);
    hub.run_until_idle();
    EXPECT_EQ(seqs(), Seqs{1});
}

TEST(SelfContainedJpeg, LowersTheQualityUntilItFits) {
    YuyvImage noise(640, 480);
    std::mt19937 random(8);
    for (auto& byte : noise.data) byte = static_cast<std::uint8_t>(100 + random() % 40);
    const FrameInfo info = info_of(0, 640, 480);
    const image_t image = self_contained_jpeg(info, "front", noise.view(), 90, 60000);
    EXPECT_LE(image.getEncodedSize(), 60000);
    EXPECT_GT(image.getEncodedSize(), 40000);
    EXPECT_EQ(problem(image), std::nullopt);
    EXPECT_EQ(self_contained_jpeg(info, "front", noise.view(), 90, 10).data, jpeg_from_yuyv(noise.view(), 1));
    EXPECT_EQ(self_contained_jpeg(info, "front", noise.view(), 90, 10'000'000).data,
              jpeg_from_yuyv(noise.view(), 90));
}

}  // namespace
}  // namespace goalmouth
