#include "tools/evaluate/progress.h"

#include <gmock/gmock.h>

namespace goalmouth {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ProgressLine, SaysShareCountRateAndTimeLeft) {
    EXPECT_EQ(progress_line(1800, 3600, "frames", 100.0),
              "[===============>              ]   50 %  1800/3600 frames  18.0/s  1:40 left");
    EXPECT_THAT(progress_line(1, 3600, "frames", 2.0), HasSubstr("  0.5/s  1:59:58 left"));
    EXPECT_THAT(progress_line(99, 100, "runs", 990.0), HasSubstr("99 %  99/100 runs  0.1/s  0:10 left"));
}

TEST(ProgressLine, HasNoRateBeforeTheFirstAndNoTimeLeftAfterTheLast) {
    EXPECT_EQ(progress_line(0, 8, "frames", 3.0), "[>                             ]    0 %  0/8 frames");
    EXPECT_THAT(progress_line(4, 8, "frames", 0.0), Not(HasSubstr("/s")));
    EXPECT_EQ(progress_line(8, 8, "frames", 4.0),
              "[==============================]  100 %  8/8 frames  2.0/s");
}

TEST(ProgressLine, StaysALineWhateverTheNumbers) {
    EXPECT_THAT(progress_line(0, 0, "frames", 0.0), HasSubstr("100 %  0/0 frames"));
    const std::string slow = progress_line(1, 1'000'000'000, "frames", 1e6);
    EXPECT_THAT(slow, HasSubstr(" left"));
    EXPECT_EQ(slow.find('\n'), std::string::npos);
    EXPECT_EQ(progress_line(999, 1000, "frames", 1.0).find("100 %"), std::string::npos)
        << "not the whole before the last one";
}

TEST(Progress, WritesNoBarWhereNobodyWatches) {
    testing::internal::CaptureStderr();
    {
        Progress progress(3, "frames");
        for (int i = 0; i < 3; ++i) progress.step();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace goalmouth
