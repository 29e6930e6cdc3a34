#include "core/imaging/file_error.h"
#include "core/imaging/jpeg.h"
#include "core/imaging/v4l2_source.h"
#include "tests/core/imaging/fake_v4l2.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <functional>
#include <limits>
#include <poll.h>
#include <set>
#include <span>
#include <string>
#include <time.h>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace std::chrono_literals;
using test::FakeCamera;
using testing::HasSubstr;

std::int64_t now_us(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
}

/// Slots as a ring has them: the one announced (here: taken) longest ago comes next.
class Slots : public FrameMemory {
  public:
    explicit Slots(int count) : pages_(static_cast<std::size_t>(count)), ages_(pages_.size(), 0) {}
    FrameSlot open(std::size_t bytes) override {
        if (!room) return {};
        EXPECT_LE(bytes, sizeof(Page));
        const auto oldest = std::min_element(ages_.begin(), ages_.end());
        EXPECT_NE(*oldest, is_open) << "all are open";
        *oldest = is_open;
        const auto number = oldest - ages_.begin();
        return {*this, static_cast<int>(number),
                std::span(pages_[static_cast<std::size_t>(number)].bytes).first(bytes)};
    }
    int slots() const override { return static_cast<int>(pages_.size()); }
    void announce(FrameSlot slot) { ages_[static_cast<std::size_t>(slot.take())] = ++clock_; }
    int open_slots() const { return static_cast<int>(std::count(ages_.begin(), ages_.end(), is_open)); }
    bool holds(const std::uint8_t* memory) const {
        return std::any_of(pages_.begin(), pages_.end(), [&](const Page& p) { return p.bytes == memory; });
    }
    bool all_are(std::uint8_t value) const {
        return std::all_of(pages_.begin(), pages_.end(), [&](const Page& p) { return p.bytes[0] == value; });
    }
    void fill(std::uint8_t value) {
        for (Page& p : pages_) std::fill(std::begin(p.bytes), std::end(p.bytes), value);
    }
    bool room = true;
    std::function<void()> when_abandoned;

  private:
    static constexpr int is_open = std::numeric_limits<int>::max();
    struct alignas(4096) Page {
        std::uint8_t bytes[4096];
    };
    void abandon(int number) noexcept override {
        ages_[static_cast<std::size_t>(number)] = 0;
        if (when_abandoned) when_abandoned();
    }
    std::vector<Page> pages_;
    std::vector<int> ages_;
    int clock_ = 0;
};

class V4l2 : public testing::Test {
  protected:
    V4l2() {
        settings_.device = FakeCamera::path;
        settings_.width = 8;
        settings_.height = 4;
        settings_.frames_per_second = 0.0;
    }
    void frame(std::uint32_t sequence, std::uint8_t value = 0, std::size_t bytes = 64) {
        camera_.events.push_back({std::vector<std::uint8_t>(bytes, value), sequence,
                                  V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, now_us(CLOCK_MONOTONIC), 0});
    }
    void error(int number) {
        FakeCamera::Event event;
        event.error = number;
        camera_.events.push_back(event);
    }
    V4l2Source source(FrameMemory* memory = nullptr) {
        return V4l2Source(
            settings_, [this](const std::string& what) { said_.push_back(what); }, memory);
    }
    FakeCamera camera_;
    V4l2Settings settings_;
    std::vector<std::string> said_;
    Captured captured_;
};

constexpr auto captured = ImageSource::Outcome::captured;
constexpr auto nothing = ImageSource::Outcome::nothing;

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

TEST_F(V4l2, TheDriverWritesIntoTheSlotsItself) {
    camera_.takes_user_memory = true;
    Slots slots(12);
    auto s = source(&slots);
    EXPECT_TRUE(s.in_place());
    EXPECT_EQ(camera_.queued, 4);
    EXPECT_EQ(slots.open_slots(), 4);
    std::set<int> seen;
    for (std::uint32_t i = 0; i < 40; ++i) {
        frame(i, static_cast<std::uint8_t>(i));
        ASSERT_EQ(s.next(captured_, 10ms), captured);
        ASSERT_TRUE(captured_.slot);
        EXPECT_EQ(captured_.bytes.data(), captured_.slot.bytes().data());
        EXPECT_TRUE(slots.holds(captured_.bytes.data()));
        EXPECT_EQ(captured_.bytes[0], i);
        EXPECT_EQ(captured_.bytes.size(), 64U);
        EXPECT_EQ(slots.open_slots(), 4) << "three the driver has, one we have";
        seen.insert(captured_.slot.number());
        slots.announce(std::move(captured_.slot));
    }
    EXPECT_EQ(seen.size(), 12U) << "each slot has its turn";
    for (const auto& [memory, numbers] : camera_.numbers_of_memory) EXPECT_EQ(numbers.size(), 1U);
    EXPECT_EQ(camera_.mapped, 0);
    EXPECT_TRUE(said_.empty());
}

TEST_F(V4l2, FramesNobodyAnnouncesAndDamagedOnesLeaveNoSlotOpen) {
    camera_.takes_user_memory = true;
    Slots slots(6);
    {
        auto s = source(&slots);
        for (std::uint32_t i = 0; i < 20; ++i) {
            frame(2 * i);
            camera_.events.back().flags |= V4L2_BUF_FLAG_ERROR;
            frame(2 * i + 1);
            ASSERT_EQ(s.next(captured_, 1000ms), captured);
            EXPECT_EQ(slots.open_slots(), 4);
        }
        EXPECT_EQ(s.counters().damaged, 20);
    }
    EXPECT_EQ(slots.open_slots(), 1) << "the one we hold";
    captured_ = {};
    EXPECT_EQ(slots.open_slots(), 0);
}

TEST_F(V4l2, AVanishedDriverGivesItsSlotsBackAndWritesThereNoMore) {
    camera_.takes_user_memory = true;
    Slots slots(6);
    auto s = source(&slots);
    frame(0);
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    slots.announce(std::move(captured_.slot));
    camera_.unplugged = true;
    int before_closing = 0;
    slots.when_abandoned = [&] { before_closing += camera_.opened != camera_.closed; };
    EXPECT_EQ(s.next(captured_, 10ms), nothing);
    EXPECT_LE(before_closing, 1) << "only the one it did not take any more";
    slots.when_abandoned = nullptr;
    EXPECT_EQ(camera_.opened, camera_.closed);
    EXPECT_EQ(slots.open_slots(), 0);
    slots.fill(9);
    camera_.scribble(77);
    EXPECT_TRUE(slots.all_are(9));

    camera_.unplugged = false;
    camera_.events.clear();
    frame(0, 55);
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (s.next(captured_, 10ms) != captured) ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    EXPECT_TRUE(captured_.slot);
    EXPECT_EQ(captured_.bytes[0], 55);
    EXPECT_TRUE(s.in_place());
    captured_ = {};
}

TEST_F(V4l2, ADriverThatDoesNotTakeTheSlotsIsSaidOnceAndUsesItsOwnMemory) {
    for (const int way : {0, 1, 2}) {
        said_.clear();
        camera_.takes_user_memory = way != 0;
        camera_.user_queue_error = way == 1 ? EFAULT : 0;
        camera_.user_buffers = way == 2 ? 3 : 32;
        Slots slots(6);
        auto s = source(&slots);
        EXPECT_FALSE(s.in_place());
        EXPECT_EQ(slots.open_slots(), 0);
        EXPECT_EQ(camera_.queued, 4);
        for (std::uint32_t i = 0; i < 10; ++i) {
            frame(i, static_cast<std::uint8_t>(i));
            ASSERT_EQ(s.next(captured_, 10ms), captured);
            EXPECT_FALSE(captured_.slot);
            EXPECT_EQ(captured_.bytes[0], i);
        }
        ASSERT_EQ(said_.size(), 1U);
        EXPECT_THAT(said_[0], HasSubstr("each image is copied once"));
    }
}

TEST_F(V4l2, ADriverThatKeepsTheSlotsItRefusedIsClosedBeforeTheyAreGivenBack) {
    camera_.takes_user_memory = true;
    camera_.user_stream_error = EIO;
    camera_.release_error = EBUSY;
    Slots slots(6);
    int while_open = 0;
    slots.when_abandoned = [&] { while_open += camera_.opened != camera_.closed; };
    auto s = source(&slots);
    EXPECT_EQ(while_open, 0);
    EXPECT_EQ(slots.open_slots(), 0);
    EXPECT_EQ(camera_.opened, 2);
    EXPECT_FALSE(s.in_place());
    slots.fill(9);
    frame(0, 44);
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_EQ(captured_.bytes[0], 44);
    EXPECT_TRUE(slots.all_are(9));
    ASSERT_EQ(said_.size(), 1U);
    EXPECT_THAT(said_[0], HasSubstr("each image is copied once"));
}

TEST_F(V4l2, ADriverThatNeedsMoreBuffersDoesNotTakeThemFromTheReadableSlots) {
    camera_.takes_user_memory = true;
    camera_.least_buffers = 6;
    Slots slots(12);
    auto s = source(&slots);
    EXPECT_FALSE(s.in_place());
    EXPECT_EQ(slots.open_slots(), 0);
    EXPECT_EQ(camera_.queued, 6) << "of its own";
    ASSERT_EQ(said_.size(), 1U);
    EXPECT_THAT(said_[0], HasSubstr("it needs 6 buffers at once"));
}

TEST_F(V4l2, FramesLostByTheChangeToSlotsAreCountedByTheRate) {
    camera_.takes_user_memory = true;
    settings_.frames_per_second = 50.0;
    Slots slots(6);
    slots.room = false;
    auto s = source(&slots);
    const std::int64_t begun = now_us(CLOCK_MONOTONIC);
    frame(7);
    camera_.events.back().monotonic_us = begun;
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    slots.room = true;
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (!s.in_place()) {
        ASSERT_LT(std::chrono::steady_clock::now(), deadline);
        s.next(captured_, 10ms);
    }
    frame(0);
    camera_.events.back().monotonic_us = begun + 1'100'000;  // 55 periods
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_EQ(captured_.lost, 54);
    EXPECT_EQ(s.counters().lost, 54);
    captured_ = {};
}

TEST_F(V4l2, WhileThereIsNoRoomForSlotsTheDriversMemoryIsUsed) {
    camera_.takes_user_memory = true;
    Slots slots(6);
    slots.room = false;
    auto s = source(&slots);
    frame(0, 1);
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_FALSE(captured_.slot);
    slots.room = true;
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    for (std::uint32_t i = 1; !s.in_place(); ++i) {
        ASSERT_LT(std::chrono::steady_clock::now(), deadline);
        s.next(captured_, 10ms);
    }
    frame(0, 3);
    ASSERT_EQ(s.next(captured_, 10ms), captured);
    EXPECT_TRUE(captured_.slot);
    EXPECT_EQ(captured_.bytes[0], 3);
    EXPECT_EQ(s.counters().reopened, 0);
    captured_ = {};
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
