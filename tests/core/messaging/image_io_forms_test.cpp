// The forms an image comes in, live and from logs.

#include "tests/core/messaging/image_io_fixture.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

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

}  // namespace
}  // namespace goalmouth
