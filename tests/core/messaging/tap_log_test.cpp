#include "core/messaging/tap_log.h"

#include "tests/support/data.h"
#include "tests/support/example_messages.h"

#include <chrono>
#include <cstdint>
#include <vector>

#include <goalmouth/image_slice_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using namespace std::chrono_literals;

constexpr std::int64_t begin_utime = 1'700'000'000'000'000;

image_t image_of(std::int32_t bytes, std::int64_t seq = 0) {
    image_t image = example_image();
    image.utime += 33'333 * seq;
    image.seq = seq;
    image.data.assign(static_cast<std::size_t>(bytes), 7);
    image.size = image.data_size = bytes;
    return image;
}

TEST(TapLog, StampsCountFromTheWallClockAtTheBeginning) {
    const TemporaryFolder folder;
    const TapLog::Time begin{1234s};
    TapLog log(folder.path() / "log", 32000, "IMAGE_TAP", "IMAGE_SLICES", begin_utime, begin);
    log.write("POSE", std::vector<std::uint8_t>{1}, begin);
    log.write(image_of(1000), begin + 5ms);
    log.write("POSE", std::vector<std::uint8_t>{2}, begin + 1h);
    const auto events = read_log(log.file());
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].utime, begin_utime);
    EXPECT_EQ(events[1].utime, begin_utime + 5000);
    EXPECT_EQ(events[1].channel, "IMAGE_TAP");
    EXPECT_EQ(events[2].utime, begin_utime + 3'600'000'000);
}

TEST(TapLog, SlicesAreSpreadOverTheFrameIntervalWithMessagesBetween) {
    const TemporaryFolder folder;
    const TapLog::Time begin{1234s};
    TapLog log(folder.path() / "log", 10000, "IMAGE_TAP", "IMAGE_SLICES", begin_utime, begin);
    log.write(image_of(600'000), begin);
    log.write("POSE", std::vector<std::uint8_t>{1}, begin + 10ms);
    log.write(image_of(600'000, 1), begin + 33333us);
    log.finish();
    std::vector<std::int64_t> slices;  // of the second, when it is known how fast they come
    std::int64_t pose = 0;
    std::int64_t last = begin_utime;
    for (const LogEvent& event : read_log(log.file())) {
        EXPECT_GE(event.utime, last);
        last = event.utime;
        if (event.channel == "POSE") pose = event.utime;
        if (event.channel != "IMAGE_SLICES") continue;
        image_slice_t slice{};
        ASSERT_GE(slice.decode(event.data.data(), 0, static_cast<int>(event.data.size())), 0);
        if (slice.seq == 1) slices.push_back(event.utime - begin_utime);
    }
    EXPECT_EQ(pose, begin_utime + 10'000);
    ASSERT_EQ(slices.size(), 61U);  // the message is larger than its pixels
    for (std::size_t i = 1; i < slices.size(); ++i)
        EXPECT_NEAR(static_cast<double>(slices[i] - slices[i - 1]), 492.0, 2.0);  // 0.9 · 33.3 ms / 61
    EXPECT_EQ(log.left_out(), 0);
}

}  // namespace
}  // namespace goalmouth
