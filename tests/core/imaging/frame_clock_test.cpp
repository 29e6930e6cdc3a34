#include "core/imaging/frame_clock.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(FrameClock, DoesNotDrift) {
    const FrameClock clock(1700000000000000, 30.0);
    EXPECT_EQ(clock.utime(0), 1700000000000000);
    EXPECT_EQ(clock.utime(1), 1700000000033333);
    EXPECT_EQ(clock.utime(2), 1700000000066667);
    EXPECT_EQ(clock.utime(30 * 3600), 1700000000000000 + 3600000000LL);
}

TEST(FrameClock, LatestIsTheLastTimeThatHasCome) {
    const FrameClock clock(1000, 30.0);
    EXPECT_EQ(clock.latest(999), -1);
    EXPECT_EQ(clock.latest(1000), 0);
    for (std::int64_t k = 0; k < 10000; k += 7) {
        EXPECT_EQ(clock.latest(clock.utime(k)), k);
        EXPECT_EQ(clock.latest(clock.utime(k) - 1), k - 1);
    }
}

}  // namespace
}  // namespace goalmouth
