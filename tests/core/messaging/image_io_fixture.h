#pragma once

#include "core/messaging/channels.h"
#include "core/messaging/image_input.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "tests/support/example_messages.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth::test {

inline YuyvImage picture(int width, int height, std::uint8_t value) {
    YuyvImage image(width, height);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<std::uint8_t>(value + i % 7);
    return image;
}

inline FrameInfo info_of(std::int64_t seq, int width = 64, int height = 48) {
    FrameInfo info;
    info.utime = 1'000'000'000 + 33'333 * seq;
    info.seq = seq;
    info.intrinsics = example_intrinsics(width, height);
    info.exposure_us = 5000;
    return info;
}

inline std::vector<std::uint8_t> bytes_of(const YuyvView& view) {
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < view.height; ++y)
        bytes.insert(bytes.end(), view.row(y), view.row(y) + yuyv_row_bytes(view.width));
    return bytes;
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

}  // namespace goalmouth::test
