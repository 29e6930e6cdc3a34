// Frames that the driver writes where their readers look.

#include "tests/core/imaging/v4l2_fixture.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

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

}  // namespace
}  // namespace goalmouth
