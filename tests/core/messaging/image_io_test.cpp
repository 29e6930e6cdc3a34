#include "core/imaging/capture_buffer.h"
#include "core/imaging/jpeg.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_input.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "tests/support/example_messages.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

YuyvImage picture(int width, int height, std::uint8_t value) {
    YuyvImage image(width, height);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<std::uint8_t>(value + i % 7);
    return image;
}

FrameInfo info_of(std::int64_t seq, int width = 64, int height = 48) {
    FrameInfo info;
    info.utime = 1'000'000'000 + 33'333 * seq;
    info.seq = seq;
    info.intrinsics = example_intrinsics(width, height);
    info.exposure_us = 5000;
    return info;
}

std::vector<std::uint8_t> bytes_of(const YuyvView& view) {
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < view.height; ++y)
        bytes.insert(bytes.end(), view.row(y), view.row(y) + yuyv_row_bytes(view.width));
    return bytes;
}

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

/// A camera, a tap's channels and a consumer on one hub.
struct ImageIo : testing::Test {
    MemoryHub hub;
    Bus& sender = hub.endpoint("camera");
    Bus& receiver = hub.endpoint("consumer");
    ImageOutput output{sender, channels::image, "front"};
    struct Seen {
        std::int64_t seq;
        std::int64_t dropped_before;
        std::vector<std::uint8_t> pixels;
        bool live;
        bool operator==(std::int64_t other) const { return seq == other; }
    };
    std::vector<Seen> seen;
    ImageInput input{
        receiver, channels::image, channels::image_tap, channels::image_slices, [this](const Frame& frame) {
            EXPECT_EQ(frame.camera, "front");
            EXPECT_EQ(frame.utime, 1'000'000'000 + 33'333 * frame.seq);
            EXPECT_EQ(frame.exposure_us, 5000);
            EXPECT_EQ(frame.pixels.width, frame.intrinsics.width);
            seen.push_back(
                {frame.seq, frame.dropped_before, bytes_of(frame.pixels), frame.ring_frame.has_value()});
            EXPECT_TRUE(frame.still_valid());
        }};

    void send_live(std::int64_t seq) {
        output.publish(info_of(seq), picture(64, 48, static_cast<std::uint8_t>(seq)).view());
    }
    image_t whole(std::int64_t seq) const {
        return self_contained_yuyv(info_of(seq), "front",
                                   picture(64, 48, static_cast<std::uint8_t>(seq)).view());
    }
    void send_whole(std::int64_t seq) { publish(sender, channels::image_tap, whole(seq)); }
    void send_slices(std::int64_t seq) {
        SlicePacer pacer(1000);
        SlicePacer::Time now;
        pacer.offer(whole(seq), now);
        while (const auto wait = pacer.next_due(now)) {
            now += *wait;
            publish(sender, channels::image_slices, *pacer.due(now));
        }
    }
    std::vector<std::int64_t> seqs() const {
        std::vector<std::int64_t> all;
        for (const auto& frame : seen) all.push_back(frame.seq);
        return all;
    }
    using Seqs = std::vector<std::int64_t>;
};

TEST_F(ImageIo, AFrameArrivesBySharedMemory) {
    send_live(0);
    hub.run_until_idle();
    ASSERT_EQ(seqs(), Seqs{0});
    EXPECT_TRUE(seen[0].live);
    EXPECT_EQ(seen[0].pixels, picture(64, 48, 0).data);
    EXPECT_EQ(receiver.counters().rejected_total(), 0);
}

TEST_F(ImageIo, AFrameWrittenInPlaceIsReadInPlace) {
    std::vector<const std::uint8_t*> pixels, slots;
    ImageInput consumer(receiver, channels::image, "", "", [&](const Frame& frame) {
        pixels.push_back(frame.pixels.data);
        slots.push_back(frame.ring_frame->bytes().data());
    });
    const YuyvImage image = picture(64, 48, 7);
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        Captured captured;
        CaptureBuffer buffer(&output);
        const auto memory = buffer.prepare(captured, 64, 48);
        std::copy(image.data.begin(), image.data.end(), memory.begin());
        EXPECT_TRUE(output.publish(info_of(seq), captured));
        EXPECT_FALSE(captured.slot);
        hub.run_until_idle();
    }
    EXPECT_EQ(pixels, slots);
    ASSERT_EQ(seqs(), (Seqs{0, 1, 2}));
    EXPECT_EQ(seen[2].pixels, image.data);
    EXPECT_EQ(output.frames_in_place(), 3);
    send_live(3);
    EXPECT_EQ(output.copied_frames(), 1);
    EXPECT_EQ(output.counters()[1].second, 1.0);
}

TEST_F(ImageIo, ASlotThatIsNotAnnouncedIsGivenBack) {
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(output.open(1000));
    FrameSlot kept = output.open(1000);
    EXPECT_THROW(output.open(1'000'000), std::logic_error) << "the ring cannot be replaced now";
    kept = {};
    EXPECT_TRUE(output.open(1'000'000));
    hub.run_until_idle();
    EXPECT_TRUE(seen.empty());
}

TEST_F(ImageIo, TheSameFrameArrivesFromEachSelfContainedForm) {
    send_whole(0);
    send_slices(1);
    hub.run_until_idle();
    ASSERT_EQ(seqs(), (Seqs{0, 1}));
    EXPECT_EQ(seen[0].pixels, picture(64, 48, 0).data);
    EXPECT_EQ(seen[1].pixels, picture(64, 48, 1).data);
    EXPECT_FALSE(seen[1].live);
}

TEST_F(ImageIo, LiveEachFrameIsHandedOutOnceAndItsOtherFormsAreLeftAlone) {
    for (std::int64_t seq = 0; seq < 5; ++seq) {
        send_live(seq);
        hub.run_until_idle();
        send_slices(seq);
        send_whole(seq);
        hub.run_until_idle();
    }
    EXPECT_EQ(seqs(), (Seqs{0, 1, 2, 3, 4}));
    EXPECT_EQ(input.frames(), 5);
    EXPECT_EQ(input.dropped(), 0);
    EXPECT_EQ(input.incomplete(), 0);
}

TEST_F(ImageIo, ALateConsumerGetsTheNewestFrameAndCountsTheRest) {
    send_live(0);
    hub.run_until_idle();
    for (std::int64_t seq = 1; seq < 5; ++seq) {
        send_live(seq);
        send_slices(seq - 1);
    }
    hub.run_until_idle();
    EXPECT_EQ(seqs(), (Seqs{0, 4}));
    EXPECT_EQ(seen[1].dropped_before, 3);
    EXPECT_EQ(input.dropped(), 3);
}

TEST_F(ImageIo, OnReplayTheRingIsGoneAndEveryTappedFrameIsUsed) {
    image_t descriptor = example_descriptor();
    descriptor.camera = "front";
    for (std::int64_t seq = 0; seq < 6; ++seq) {
        descriptor.utime = info_of(seq).utime;
        descriptor.seq = seq;
        publish(sender, channels::image, descriptor);
        hub.run_until_idle();
        if (seq % 2 == 0) {
            send_slices(seq);
        } else {
            send_whole(seq);
        }
        hub.run_until_idle();
    }
    EXPECT_EQ(seqs(), (Seqs{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(input.frame_gone(), 6);
    EXPECT_EQ(input.dropped(), 0);
    EXPECT_EQ(receiver.counters().rejected_total(), 0);
}

TEST_F(ImageIo, ALogPlayedAgainIsTakenAgain) {
    for (int round = 0; round < 2; ++round) {
        for (std::int64_t seq = 0; seq < 3; ++seq) send_slices(seq);
        hub.run_until_idle();
    }
    EXPECT_EQ(seqs(), (Seqs{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(input.dropped(), 0);
}

TEST_F(ImageIo, ACameraStartedAnewIsTaken) {
    for (std::int64_t seq = 0; seq < 3; ++seq) send_live(seq), hub.run_until_idle();
    ImageOutput second(sender, channels::image, "front");
    second.publish(info_of(0), picture(64, 48, 0).view());
    hub.run_until_idle();
    EXPECT_EQ(seqs(), (Seqs{0, 1, 2, 0}));
    EXPECT_EQ(input.dropped(), 0);
}

TEST_F(ImageIo, AReplayIntoAConsumerThatWasLiveIsTakenOnceTheRingIsGone) {
    image_t last;
    subscribe<image_t>(receiver, channels::image, [&](const image_t& m) { last = m; });
    {
        ImageOutput camera(sender, channels::image, "front");
        for (std::int64_t seq = 0; seq < 3; ++seq) {
            camera.publish(info_of(seq), picture(64, 48, 0).view());
            hub.run_until_idle();
        }
    }
    last.ring += "0";  // as if the ring had never been mapped here
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        last.seq = seq;
        last.utime = info_of(seq).utime;
        publish(sender, channels::image, last);
        hub.run_until_idle();
        send_slices(seq);
        hub.run_until_idle();
    }
    EXPECT_EQ(seqs(), (Seqs{0, 1, 2, 0, 1, 2}));
}

TEST_F(ImageIo, FramesMayBeWrittenInPlaceAndGrow) {
    const YuyvImage small = picture(64, 48, 1);
    Captured captured;
    CaptureBuffer buffer(&output);
    const auto memory = buffer.prepare(captured, 64, 48);
    std::copy(small.data.begin(), small.data.end(), memory.begin());
    EXPECT_EQ(output.slot_bytes(), 8192U) << "whole pages";
    EXPECT_TRUE(output.publish(info_of(0), captured));
    hub.run_until_idle();
    const std::string first_ring = output.ring();
    output.publish(info_of(1, 640, 480), picture(640, 480, 2).view());
    hub.run_until_idle();
    EXPECT_NE(output.ring(), first_ring);
    ASSERT_EQ(seqs(), (Seqs{0, 1}));
    EXPECT_EQ(seen[0].pixels, small.data);
    EXPECT_EQ(seen[1].pixels, picture(640, 480, 2).data);
}

TEST_F(ImageIo, RowsWithGapsArePacked) {
    YuyvImage wide = picture(80, 48, 3);
    const YuyvView view{wide.data.data(), 64, 48, wide.stride()};
    output.publish(info_of(0), view);
    publish(sender, channels::image_tap, self_contained_yuyv(info_of(1), "front", view));
    hub.run_until_idle();
    for (const auto& frame : seen) EXPECT_EQ(frame.pixels, bytes_of(view));
}

TEST_F(ImageIo, OddWidthsSurvive) {
    const YuyvImage odd = picture(63, 5, 9);
    output.publish(info_of(0, 63, 5), odd.view());
    hub.run_until_idle();
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].pixels, odd.data);
    publish(sender, channels::image_tap, self_contained_yuyv(info_of(100, 63, 5), "front", odd.view()));
    hub.run_until_idle();
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_EQ(seen[1].pixels, odd.data);
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

TEST_F(ImageIo, AFrameLargerThanAnyRingIsMissedNotFatal) {
    EXPECT_FALSE(output.open(FrameRing::most_slot_bytes + 1));
    send_live(0);
    EXPECT_FALSE(output.open(FrameRing::most_slot_bytes + 1)) << "and the ring there is stays";
    send_live(1);
    EXPECT_EQ(output.copied_frames(), 2);
    EXPECT_EQ(output.missed_frames(), 0);
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

TEST_F(ImageIo, SlicesThatHoldAnotherImageThanTheySayAreRefused) {
    SlicePacer pacer(65000);
    SlicePacer::Time now;
    pacer.offer(whole(5), now);
    auto slice = pacer.due(now).value();
    for (const auto& change : std::vector<std::function<void(image_slice_t&)>>{
             [](image_slice_t& m) { m.seq = 4; }, [](image_slice_t& m) { m.utime += 1; },
             [](image_slice_t& m) { m.camera = "rear"; }, [](image_slice_t& m) { m.data[0] ^= 1; }}) {
        image_slice_t forged = slice;
        change(forged);
        publish(sender, channels::image_slices, forged);
    }
    hub.run_until_idle();
    EXPECT_TRUE(seen.empty());
    EXPECT_EQ(receiver.counters().rejected_total(), 4);
}

TEST_F(ImageIo, AFrameOverwrittenDuringUseSaysSo) {
    MemoryHub other;
    Bus& bus = other.endpoint("x");
    ImageOutput camera(bus, "IMAGE", "front", 2);
    std::vector<bool> valid;
    ImageInput consumer(bus, "IMAGE", "", "", [&](const Frame& frame) {
        if (frame.seq == 0) {  // the camera goes twice round the ring meanwhile
            for (std::int64_t seq = 1; seq < 5; ++seq)
                camera.publish(info_of(seq), picture(64, 48, 0).view());
        }
        valid.push_back(frame.still_valid());
    });
    camera.publish(info_of(0), picture(64, 48, 0).view());
    other.run_until_idle();
    EXPECT_EQ(valid, (std::vector<bool>{false, true}));
}

TEST_F(ImageIo, DescriptorsReadTooLateAreCounted) {
    std::vector<std::vector<std::uint8_t>> descriptors;
    MemoryHub other;
    Bus& bus = other.endpoint("x");
    bus.subscribe("IMAGE", Delivery::every, [&](auto bytes) {
        descriptors.push_back({bytes.begin(), bytes.end()});
    });
    ImageOutput camera(bus, "IMAGE", "front", 2);
    for (std::int64_t seq = 0; seq < 5; ++seq) camera.publish(info_of(seq), picture(64, 48, 0).view());
    other.run_until_idle();
    for (const auto& descriptor : descriptors) {
        sender.publish(channels::image, descriptor);
        hub.run_until_idle();
    }
    EXPECT_EQ(seqs(), (Seqs{3, 4}));
    EXPECT_EQ(input.overwritten(), 3);
}

TEST_F(ImageIo, ManyCamerasTakeNoMemoryWithoutBound) {
    image_t m = whole(0);
    MemoryHub other;
    Bus& bus = other.endpoint("x");
    std::int64_t frames = 0;
    ImageInput consumer(bus, "", "TAP", "", [&](const Frame&) { ++frames; });
    for (int i = 0; i < 1000; ++i) {
        m.camera = "camera " + std::to_string(i);
        publish(bus, "TAP", m);
    }
    other.run_until_idle();
    EXPECT_EQ(frames, 1000);
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
