#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "tests/modules/tap/tap_fixture.h"
#include "tests/support/example_messages.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

/// A camera, the tap, and a consumer that has no shared memory, as after replay.
struct Tap : testing::Test {
    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("tap"), status, "tap", 0, {{"IMAGE_TAP", "OTHER_TAP"}}};
    ImageOutput camera{hub.endpoint("camera"), channels::image, "front"};
    std::optional<TapModule> tap;
    struct Seen {
        std::int64_t utime;
        std::int64_t seq;
        YuyvImage pixels;
    };
    std::vector<Seen> seen;
    ImageInput consumer{
        hub.endpoint("consumer"), "", "OTHER_TAP", channels::image_slices, [this](const Frame& frame) {
            EXPECT_EQ(frame.exposure_us, 4000);
            EXPECT_EQ(frame.readout_us, 9000);
            EXPECT_EQ(frame.camera, "front");
            Seen s{frame.utime, frame.seq, YuyvImage(frame.pixels.width, frame.pixels.height)};
            std::copy_n(frame.pixels.data, s.pixels.data.size(), s.pixels.data.begin());
            seen.push_back(std::move(s));
        }};
    int images = 0;
    int slices = 0;

    void start(TapParameters parameters) {
        tap.emplace(context, parameters);
        subscribe<image_t>(hub.endpoint("listener"), "OTHER_TAP", [this](const image_t& m) {
            ++images;
            EXPECT_LE(static_cast<std::size_t>(m.getEncodedSize()), datagram_bytes);
        });
        subscribe<image_slice_t>(hub.endpoint("listener"), channels::image_slices,
                                 [this](const image_slice_t& m) {
                                     ++slices;
                                     EXPECT_LE(static_cast<std::size_t>(m.getEncodedSize()), datagram_bytes);
                                 });
    }
    void send(std::int64_t seq, const YuyvImage& image) {
        camera.publish(info_of(seq, image.width, image.height), image.view());
        hub.run_until_idle();
    }
    void finish() {
        while (tap->tick() < std::chrono::seconds(1)) {
        }
        hub.run_until_idle();
    }
};

TEST_F(Tap, RawFramesComeThroughExactlyInSlices) {
    start({.encoding = "raw", .slice_bytes = 32000});
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        send(seq, noise(640, 480, static_cast<unsigned>(seq)));
        finish();
    }
    ASSERT_EQ(seen.size(), 3U);
    for (std::int64_t seq = 0; seq < 3; ++seq) {
        const auto& frame = seen[static_cast<std::size_t>(seq)];
        EXPECT_EQ(frame.seq, seq);
        EXPECT_EQ(frame.utime, 1'000'000 + 2'000 * seq);
        EXPECT_EQ(frame.pixels.data, noise(640, 480, static_cast<unsigned>(seq)).data);
    }
    EXPECT_EQ(images, 0);
    EXPECT_EQ(slices, 3 * 20);
    EXPECT_EQ(status.outputs(), 3);
    EXPECT_EQ(status.dropped_frames(), 0);
}

TEST_F(Tap, ASmallRawFrameIsOneMessage) {
    start({.encoding = "raw"});
    send(0, noise(64, 48, 1));
    finish();
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].pixels.data, noise(64, 48, 1).data);
    EXPECT_EQ(images, 1);
    EXPECT_EQ(slices, 0);
}

TEST_F(Tap, JpegsFitADatagram) {
    start({.encoding = "jpeg", .jpeg_quality = 95});
    send(0, noise(640, 480, 1));
    finish();
    EXPECT_EQ(images, 1);
    EXPECT_EQ(slices, 0);
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].pixels.width, 640);
    EXPECT_EQ(status.outputs(), 1);
}

TEST_F(Tap, OnlyFramesItsIntervalDividesAreSent) {
    start({.encoding = "raw", .every = 3});
    for (std::int64_t seq = 0; seq < 10; ++seq) send(seq, noise(64, 48, 1));
    finish();
    std::vector<std::int64_t> seqs;
    for (const auto& frame : seen) seqs.push_back(frame.seq);
    EXPECT_EQ(seqs, (std::vector<std::int64_t>{0, 3, 6, 9}));
    EXPECT_EQ(status.dropped_frames(), 0);
}

TEST_F(Tap, FramesThatPileUpAreDroppedAndCounted) {
    start({.encoding = "raw"});
    for (std::int64_t seq = 0; seq < 12; ++seq) send(seq, noise(640, 480, 1));
    finish();
    EXPECT_EQ(seen.size(), 9U);
    EXPECT_EQ(status.dropped_frames(), 3);
}

TEST_F(Tap, GarbageOnTheImageChannelIsSkipped) {
    start({.encoding = "raw"});
    hub.endpoint("camera").publish(channels::image, std::vector<std::uint8_t>(300, 7));
    publish(hub.endpoint("camera"), channels::image, example_descriptor());
    send(0, noise(64, 48, 1));
    finish();
    EXPECT_EQ(seen.size(), 1U);
    EXPECT_EQ(hub.endpoint("tap").counters().rejected_total(), 1);
}

TEST(TapConfiguration, ListsEveryParameterWithItsDefault) {
    const auto loaded =
        load_parameters<TapParameters>(std::string(GOALMOUTH_SOURCE_DIR) + "/config/modules/tap.yaml");
    const auto in_file = list_parameters(loaded);
    const auto defaults = list_parameters<TapParameters>();
    ASSERT_EQ(in_file.size(), defaults.size());
    for (std::size_t i = 0; i < defaults.size(); ++i)
        EXPECT_EQ(in_file[i].value, defaults[i].value) << defaults[i].key;
    const auto file =
        Configuration::from_file(std::string(GOALMOUTH_SOURCE_DIR) + "/config/modules/tap.yaml");
    for (const auto& parameter : defaults) {
        if (parameter.key == "file") continue;  // none
        EXPECT_NE(file.text(parameter.key), "") << parameter.key;
    }
}

}  // namespace
}  // namespace goalmouth
