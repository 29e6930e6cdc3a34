#include "core/imaging/file_error.h"
#include "core/imaging/jpeg.h"
#include "tests/core/imaging/v4l2_fixture.h"

#include <cerrno>
#include <chrono>
#include <poll.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

TEST_F(V4l2, DeliversFramesAndGivesEachBufferBack) {
    auto s = source();
    EXPECT_EQ(camera_.queued, 4);
    for (std::uint32_t i = 0; i < 20; ++i) {
        frame(i, static_cast<std::uint8_t>(i));
        ASSERT_EQ(s.next(captured_, 10ms), captured);
        EXPECT_EQ(captured_.bytes.size(), 64U);
        EXPECT_EQ(captured_.bytes[0], i);
        EXPECT_EQ(captured_.stride, 16);
        EXPECT_EQ(camera_.queued, 3) << "the frame in use";
    }
    EXPECT_EQ(s.next(captured_, 0ms), nothing);
    EXPECT_EQ(camera_.queued, 4);
}

TEST_F(V4l2, StopsCleanly) {
    {
        auto s = source();
        frame(0);
        ASSERT_EQ(s.next(captured_, 10ms), captured);
    }
    EXPECT_FALSE(camera_.streaming);
    EXPECT_EQ(camera_.opened, camera_.closed);
    EXPECT_EQ(camera_.mapped, 4);
    EXPECT_EQ(camera_.unmapped, 4);
}

TEST_F(V4l2, TimeStampsBecomeUtc) {
    auto s = source();
    const std::int64_t before = now_us(CLOCK_REALTIME);
    frame(0);
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_GE(captured_.utime, before - 1000);
    EXPECT_LE(captured_.utime, now_us(CLOCK_REALTIME) + 1000);

    camera_.events.push_back({std::vector<std::uint8_t>(64), 1, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC,
                              now_us(CLOCK_MONOTONIC) - 500000, 0});
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_NEAR(static_cast<double>(now_us(CLOCK_REALTIME) - captured_.utime), 500000.0, 100000.0);
}

TEST_F(V4l2, HandsMotionJpegOnWithItsLength) {
    YuyvImage image(8, 4);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = i % 2 == 0 ? 90 : 128;
    const std::vector<std::uint8_t> jpeg = jpeg_from_yuyv(image.view(), 95);
    camera_.offered = V4L2_PIX_FMT_MJPEG;
    settings_.format = PixelFormat::jpeg;
    auto s = source();
    camera_.events.push_back({jpeg, 0, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, 1, 0});
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_EQ(captured_.format, PixelFormat::jpeg);
    EXPECT_EQ(captured_.bytes.size(), jpeg.size());
    EXPECT_NEAR(yuyv_from_jpeg(captured_.bytes).view().at(3, 2).y, 90, 3);
}

TEST_F(V4l2, TakesWhatSomeDriversCallJpeg) {
    camera_.offered = V4L2_PIX_FMT_JPEG;
    settings_.format = PixelFormat::jpeg;
    auto s = source();
    EXPECT_TRUE(s.connected());
}

TEST_F(V4l2, SignalsAreNoFailures) {
    camera_.interrupted_ioctls = 3;
    auto s = source();
    frame(0);
    camera_.interrupted_polls = 1;
    EXPECT_EQ(s.next(captured_, 10ms), nothing) << "whoever got the signal may want to stop";
    camera_.interrupted_ioctls = 2;
    EXPECT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_TRUE(said_.empty());
}

TEST_F(V4l2, AWakeUpWithoutAFrameIsNoFailure) {
    auto s = source();
    error(EAGAIN);
    frame(0);
    EXPECT_EQ(s.next(captured_, 1000ms), captured);
}

TEST_F(V4l2, DamagedAndShortFramesAreSkippedAndCounted) {
    auto s = source();
    frame(0);
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    frame(1);
    camera_.events.back().flags |= V4L2_BUF_FLAG_ERROR;
    frame(2, 0, 63);
    error(EIO);
    frame(3, 33);
    ASSERT_EQ(s.next(captured_, 1000ms), captured);
    EXPECT_EQ(captured_.bytes[0], 33);
    EXPECT_EQ(captured_.lost, 2);
    EXPECT_EQ(s.counters().damaged, 3);
    EXPECT_EQ(s.counters().lost, 0);
    EXPECT_EQ(camera_.queued, 3);
}

TEST_F(V4l2, GapsInTheNumberingAreLostFrames) {
    auto s = source();
    const auto lost = [&](std::uint32_t sequence) {
        frame(sequence);
        EXPECT_EQ(s.next(captured_, 10ms), captured);
        return captured_.lost;
    };
    EXPECT_EQ(lost(100), 0) << "numbering begins anywhere";
    EXPECT_EQ(lost(101), 0);
    EXPECT_EQ(lost(105), 3);
    EXPECT_EQ(lost(5), 0) << "a driver that begins anew";
    EXPECT_EQ(lost(6), 0);
    EXPECT_EQ(s.counters().lost, 3);
}

TEST_F(V4l2, TheNumberingMayWrap) {
    auto s = source();
    for (const std::uint32_t sequence : {0xfffffffeU, 0xffffffffU, 0U, 2U}) {
        frame(sequence);
        ASSERT_EQ(s.next(captured_, 10ms), captured);
    }
    EXPECT_EQ(s.counters().lost, 1);
}

TEST_F(V4l2, AnUnpluggedCameraIsSaidOnceAndComesBack) {
    auto s = source();
    frame(7);
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    camera_.unplugged = true;
    EXPECT_EQ(s.next(captured_, 10ms), nothing);
    EXPECT_FALSE(s.connected());
    ASSERT_EQ(said_.size(), 1U);
    EXPECT_THAT(said_[0], HasSubstr("gone"));
    EXPECT_EQ(camera_.opened, camera_.closed) << "the device is let go, or it could not come back";

    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (said_.size() < 2 && std::chrono::steady_clock::now() < deadline)
        EXPECT_EQ(s.next(captured_, 10ms), nothing);
    EXPECT_THAT(said_.at(1), HasSubstr("cannot be opened"));

    camera_.unplugged = false;
    camera_.events.clear();
    frame(0, 55);
    while (s.next(captured_, 10ms) != captured) ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    EXPECT_EQ(captured_.bytes[0], 55);
    EXPECT_EQ(s.counters().reopened, 1);
    EXPECT_EQ(s.counters().lost, 0) << "its numbering began anew";
    EXPECT_THAT(said_.back(), HasSubstr("back"));
    EXPECT_EQ(said_.size(), 3U);
}

TEST_F(V4l2, AnErrorWithoutAFrameEndsTheStreamInsteadOfSpinning) {
    auto s = source();
    camera_.poll_events = POLLERR;
    EXPECT_EQ(s.next(captured_, 10ms), nothing);
    EXPECT_FALSE(s.connected());
}

TEST_F(V4l2, WhatIsNotOfferedIsAnErrorThatListsWhatIs) {
    settings_.width = 640;
    settings_.height = 480;
    try {
        auto s = source();
        FAIL() << "640x480 was accepted";
    } catch (const FileError& e) {
        EXPECT_THAT(e.what(), HasSubstr("does not offer YUYV 640x480; it offers: YUYV 8x4"));
    }
    EXPECT_EQ(camera_.opened, camera_.closed);
}

}  // namespace
}  // namespace goalmouth
