#include "core/messaging/kept_frames.h"

#include "core/imaging/jpeg.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "tests/support/example_messages.h"

#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

YuyvImage picture(std::int64_t seq, int width = 64) {
    YuyvImage image(width, 48);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<std::uint8_t>(10 * seq + static_cast<std::int64_t>(i % 7));
    return image;
}

FrameInfo info_of(std::int64_t seq, int width = 64) {
    FrameInfo info;
    info.utime = 1'000'000 + 33'333 * seq;
    info.seq = seq;
    info.intrinsics = example_intrinsics(width, 48);
    return info;
}

std::vector<std::uint8_t> bytes_of(const YuyvView& view) {
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < view.height; ++y)
        bytes.insert(bytes.end(), view.row(y), view.row(y) + yuyv_row_bytes(view.width));
    return bytes;
}

/// A camera with a small ring, and a consumer that keeps three frames.
struct Keeping : testing::Test {
    MemoryHub hub;
    Bus& sender = hub.endpoint("camera");
    ImageOutput output{sender, channels::image, "front", 3};
    KeptFrames kept{3};
    const std::uint8_t* last_pixels = nullptr;
    std::vector<std::int64_t> overwritten;
    ImageInput input{hub.endpoint("consumer"),
                     channels::image,
                     channels::image_tap,
                     "",
                     [this](const Frame& frame) {
                         kept.keep(frame);
                         last_pixels = frame.pixels.data;
                     },
                     Delivery::every};
    Keeping() {
        input.on_overwritten([this](const image_t& m) { overwritten.push_back(m.seq); });
    }
    const Frame* find(std::int64_t seq, int width = 64) const {
        const FrameInfo info = info_of(seq, width);
        return kept.find(info.utime, info.seq, info.intrinsics);
    }
    void send_live(std::int64_t seq) {
        output.publish(info_of(seq), picture(seq).view());
        hub.run_until_idle();
    }
    void send_whole(std::int64_t seq, int width = 64) {
        publish(sender, channels::image_tap,
                self_contained_yuyv(info_of(seq, width), "front", picture(seq, width).view()));
        hub.run_until_idle();
    }
    void send_jpeg(std::int64_t seq) {
        publish(sender, channels::image_tap,
                self_contained_jpeg(info_of(seq), "front", picture(seq).view(), 90, datagram_bytes));
        hub.run_until_idle();
    }
};

TEST_F(Keeping, FramesInARingStayWhereTheyStand) {
    send_live(0);
    const std::uint8_t* there = last_pixels;
    send_live(1);
    const Frame* frame = find(0);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->pixels.data, there);
    EXPECT_TRUE(frame->still_valid());
    EXPECT_EQ(bytes_of(frame->pixels), picture(0).data);
    for (std::int64_t seq = 2; seq < 4; ++seq) send_live(seq);
    EXPECT_EQ(find(0), nullptr) << "only so many are kept";
}

TEST_F(Keeping, ItShowsWhereTheCameraWasFaster) {
    send_live(0);
    for (std::int64_t seq = 1; seq < 4; ++seq) output.publish(info_of(seq), picture(seq).view());
    ASSERT_NE(find(0), nullptr);
    EXPECT_FALSE(find(0)->still_valid());
    // Descriptors that waited until their frame was gone are told of.
    for (std::int64_t seq = 4; seq < 8; ++seq) output.publish(info_of(seq), picture(seq).view());
    hub.run_until_idle();
    EXPECT_EQ(overwritten, (std::vector<std::int64_t>{1, 2, 3, 4}));
    EXPECT_TRUE(find(7)->still_valid());
}

TEST_F(Keeping, PixelsOfMessagesAreCopied) {
    for (std::int64_t seq = 0; seq < 5; ++seq) send_whole(seq, seq == 3 ? 33 : 64);
    EXPECT_EQ(find(1), nullptr);
    for (std::int64_t seq = 2; seq < 5; ++seq) {
        const Frame* frame = find(seq, seq == 3 ? 33 : 64);
        ASSERT_NE(frame, nullptr) << seq;
        EXPECT_TRUE(frame->still_valid());
        EXPECT_EQ(bytes_of(frame->pixels), picture(seq, seq == 3 ? 33 : 64).data) << seq;
    }
}

TEST_F(Keeping, EachJpegKeepsItsPixels) {
    std::vector<std::vector<std::uint8_t>> seen;
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        send_jpeg(seq);
        seen.push_back(bytes_of(find(seq)->pixels));
    }
    for (std::int64_t seq = 0; seq < 3; ++seq)
        EXPECT_EQ(bytes_of(find(seq)->pixels), seen[static_cast<std::size_t>(seq)]) << seq;
    EXPECT_NE(seen[0], seen[1]);
}

TEST_F(Keeping, AFrameOfAnotherCalibrationIsAnotherFrame) {
    send_whole(0, 64);
    EXPECT_EQ(find(0, 33), nullptr);
    send_whole(0, 33);
    EXPECT_EQ(find(0, 64)->pixels.width, 64);
    intrinsics_t other = info_of(0).intrinsics;
    other.distortion[4] = 0.01;
    EXPECT_EQ(kept.find(info_of(0).utime, 0, other), nullptr);
}

}  // namespace
}  // namespace goalmouth
