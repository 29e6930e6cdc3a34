#include "core/messaging/validation.h"
#include "tests/core/messaging/breakages.h"
#include "tests/support/example_messages.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

TEST(Validation, IntrinsicsKeepTheirRanges) {
    using M = intrinsics_t;
    expect_each_refused<M>(example_intrinsics(), {
                                                     [](M& m) { m.width = 0; },
                                                     [](M& m) { m.width = 16385; },
                                                     [](M& m) { m.height = -1; },
                                                     [](M& m) { m.height = 16385; },
                                                     [](M& m) { m.fx = 0; },
                                                     [](M& m) { m.fy = -1; },
                                                     [](M& m) { m.fx = nan; },
                                                     [](M& m) { m.cx = infinity; },
                                                     [](M& m) { m.cy = nan; },
                                                     [](M& m) { m.distortion[4] = nan; },
                                                 });
    auto largest = example_intrinsics(16384, 16384);
    EXPECT_EQ(problem(largest), std::nullopt);
}

TEST(Validation, CameraInfoKeepsItsRanges) {
    using M = camera_info_t;
    expect_each_refused<M>(example_camera_info(), {
                                                      [](M& m) { m.utime = -1; },
                                                      [](M& m) { m.camera = std::string("a\0b", 3); },
                                                      [](M& m) { m.source = std::string("\0", 1); },
                                                      [](M& m) { m.frames_per_second = -1; },
                                                      [](M& m) { m.frames_per_second = nan; },
                                                      [](M& m) { m.intrinsics.fx = 0; },
                                                  });
}

TEST(Validation, SelfContainedImagesHoldTheirPixels) {
    using M = image_t;
    expect_each_refused<M>(example_image(), {
                                                [](M& m) { m.utime = -1; },
                                                [](M& m) { m.seq = -1; },
                                                [](M& m) { m.width = 9; },
                                                [](M& m) { m.height = 3; },
                                                [](M& m) { m.intrinsics.width = 7; },
                                                [](M& m) { m.camera = std::string("a\0", 2); },
                                                [](M& m) { m.row_stride = 15; },
                                                [](M& m) { m.row_stride = 17; },
                                                [](M& m) { m.row_stride = std::numeric_limits<int>::max(); },
                                                [](M& m) { m.encoding = "rgb"; },
                                                [](M& m) { m.encoding = "jpeg"; },
                                                [](M& m) { m.exposure_us = -1; },
                                                [](M& m) { m.readout_us = -1; },
                                                [](M& m) { m.slot = 0; },
                                                [](M& m) { m.generation = 0; },
                                                [](M& m) { m.ring = "/goalmouth-0-1-a-1"; },
                                                [](M& m) { m.size = 63; },
                                                [](M& m) { m.data_size = 63; },
                                                [](M& m) { m.data_size = -1; },
                                                [](M& m) { m.data.pop_back(); },
                                                [](M& m) { m.data_size = m.size = 0, m.data.clear(); },
                                            });
    auto jpeg = example_image();
    jpeg.encoding = "jpeg";
    jpeg.row_stride = 0;
    EXPECT_EQ(problem(jpeg), std::nullopt);
    jpeg.size = jpeg.data_size = 0;
    jpeg.data.clear();
    EXPECT_TRUE(problem(jpeg).has_value());
}

TEST(Validation, AnImageOfOddWidthHoldsOnePixelMore) {
    auto image = example_image();
    image.width = image.intrinsics.width = 7;
    EXPECT_EQ(problem(image), std::nullopt);
    image.width = image.intrinsics.width = 9;
    EXPECT_TRUE(problem(image).has_value());
}

TEST(Validation, DescriptorsNameASlotAndCarryNoPixels) {
    using M = image_t;
    expect_each_refused<M>(example_descriptor(), {
                                                     [](M& m) { m.ring = ""; },
                                                     [](M& m) { m.slot = -1; },
                                                     [](M& m) { m.generation = -1; },
                                                     [](M& m) { m.data_size = 1, m.data = {1}; },
                                                     [](M& m) { m.data_size = 1; },
                                                     [](M& m) { m.size = 0; },
                                                     [](M& m) { m.size = std::numeric_limits<int>::max(); },
                                                 });
}

TEST(Validation, SlicesLieInsideTheirImage) {
    using M = image_slice_t;
    constexpr int largest = std::numeric_limits<int>::max();
    expect_each_refused<M>(example_slice(), {
                                                [](M& m) { m.utime = -1; },
                                                [](M& m) { m.seq = -1; },
                                                [](M& m) { m.camera = std::string("\0", 1); },
                                                [](M& m) { m.slices = 0; },
                                                [](M& m) { m.slice = -1; },
                                                [](M& m) { m.slice = 3; },
                                                [](M& m) { m.slices = 26; },
                                                [](M& m) { m.offset = -1; },
                                                [](M& m) { m.offset = 16; },
                                                [](M& m) { m.offset = largest; },
                                                [](M& m) { m.offset = 0; },
                                                [](M& m) { m.offset = 15; },
                                                [](M& m) { m.slice = 0; },
                                                [](M& m) { m.slice = 2; },
                                                [](M& m) { m.total_size = 0; },
                                                [](M& m) { m.total_size = 9; },
                                                [](M& m) { m.data_size = 9; },
                                                [](M& m) { m.data_size = 0, m.data.clear(); },
                                                [](M& m) { m.data_size = -1; },
                                            });
}

}  // namespace
}  // namespace goalmouth
