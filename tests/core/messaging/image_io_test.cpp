#include "core/imaging/capture_buffer.h"
#include "tests/core/messaging/image_io_fixture.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

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

TEST_F(ImageIo, AFrameLargerThanAnyRingIsMissedNotFatal) {
    EXPECT_FALSE(output.open(FrameRing::most_slot_bytes + 1));
    send_live(0);
    EXPECT_FALSE(output.open(FrameRing::most_slot_bytes + 1)) << "and the ring there is stays";
    send_live(1);
    EXPECT_EQ(output.copied_frames(), 2);
    EXPECT_EQ(output.missed_frames(), 0);
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

}  // namespace
}  // namespace goalmouth
