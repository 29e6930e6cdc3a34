#include "core/imaging/jpeg.h"

#include "core/imaging/reused_memory.h"

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <turbojpeg.h>

namespace goalmouth {
namespace {

/// Smooth in luma and chroma, so that compression changes little.
YuyvImage ramp(int width, int height) {
    YuyvImage image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int pair = 0; pair < (width + 1) / 2; ++pair) {
            std::uint8_t* p = image.data.data() + static_cast<std::ptrdiff_t>(y) * image.stride() + 4 * pair;
            p[0] = static_cast<std::uint8_t>(40 + 2 * pair);
            p[2] = static_cast<std::uint8_t>(41 + 2 * pair);
            p[1] = static_cast<std::uint8_t>(90 + y);
            p[3] = static_cast<std::uint8_t>(160 - y);
        }
    }
    return image;
}

void expect_near(const YuyvImage& image, const YuyvImage& expected, int tolerance) {
    ASSERT_EQ(image.width, expected.width);
    ASSERT_EQ(image.height, expected.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Ycbcr a = image.view().at(x, y);
            const Ycbcr b = expected.view().at(x, y);
            ASSERT_LE(std::abs(a.y - b.y), tolerance) << x << " " << y;
            ASSERT_LE(std::abs(a.cb - b.cb), tolerance) << x << " " << y;
            ASSERT_LE(std::abs(a.cr - b.cr), tolerance) << x << " " << y;
        }
    }
}

TEST(Jpeg, AnImageSurvivesAtHighQuality) {
    for (const auto& [width, height] : {std::pair{64, 48}, {63, 47}, {1, 1}, {2, 1}, {17, 1}, {1, 9}}) {
        const YuyvImage image = ramp(width, height);
        expect_near(yuyv_from_jpeg(jpeg_from_yuyv(image.view(), 100)), image, 3);
    }
}

TEST(Jpeg, FullRangeIsKept) {
    YuyvImage image(16, 16);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = i % 2 == 1 ? 128 : (i / 32) % 16 < 8 ? 0 : 255;
    expect_near(yuyv_from_jpeg(jpeg_from_yuyv(image.view(), 100)), image, 2);
}

TEST(Jpeg, RowsWithGapsAreRead) {
    const YuyvImage wide = ramp(80, 20);
    const YuyvView view{wide.data.data(), 40, 20, wide.stride()};
    expect_near(yuyv_from_jpeg(jpeg_from_yuyv(view, 100)), ramp(40, 20), 3);
}

TEST(Jpeg, LowerQualityIsSmaller) {
    const YuyvImage image = ramp(64, 48);
    EXPECT_LT(jpeg_from_yuyv(image.view(), 10).size(), jpeg_from_yuyv(image.view(), 100).size());
}

TEST(Jpeg, EverySubsamplingIsBroughtToFourTwoTwo) {
    // One colour, so that every subsampling must give it back.
    const int width = 33;
    const int height = 17;
    for (const int subsampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420, TJSAMP_440, TJSAMP_411, TJSAMP_GRAY}) {
        std::vector<unsigned char> planes[3];
        const unsigned char* data[3] = {nullptr, nullptr, nullptr};
        int strides[3] = {0, 0, 0};
        const unsigned char value[3] = {90, 60, 200};
        for (int i = 0; i < (subsampling == TJSAMP_GRAY ? 1 : 3); ++i) {
            strides[i] = tjPlaneWidth(i, width, subsampling);
            planes[i].assign(static_cast<std::size_t>(strides[i]) *
                                 static_cast<std::size_t>(tjPlaneHeight(i, height, subsampling)),
                             value[i]);
            data[i] = planes[i].data();
        }
        tjhandle codec = tjInitCompress();
        unsigned char* bytes = nullptr;
        unsigned long size = 0;
        ASSERT_EQ(
            tjCompressFromYUVPlanes(codec, data, width, strides, height, subsampling, &bytes, &size, 100, 0),
            0);
        const YuyvImage image = yuyv_from_jpeg({bytes, bytes + size});
        tjFree(bytes);
        tjDestroy(codec);
        ASSERT_EQ(image.width, width);
        ASSERT_EQ(image.height, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const Ycbcr p = image.view().at(x, y);
                EXPECT_NEAR(p.y, 90, 2) << subsampling;
                EXPECT_NEAR(p.cb, subsampling == TJSAMP_GRAY ? 128 : 60, 2) << subsampling;
                EXPECT_NEAR(p.cr, subsampling == TJSAMP_GRAY ? 128 : 200, 2) << subsampling;
            }
        }
    }
}

TEST(Jpeg, WhatIsNoJpegOrHalfOfOneIsAnError) {
    EXPECT_THROW(yuyv_from_jpeg({}), std::runtime_error);
    EXPECT_THROW(yuyv_from_jpeg(std::vector<std::uint8_t>(100, 0)), std::runtime_error);
    auto bytes = jpeg_from_yuyv(ramp(64, 48).view(), 90);
    bytes.resize(bytes.size() / 2);
    EXPECT_THROW(yuyv_from_jpeg(bytes), std::runtime_error);
    EXPECT_THROW(jpeg_from_yuyv({}, 90), std::invalid_argument);
}

TEST(Jpeg, ADecoderServesImagesOfAnySizeOneAfterTheOther) {
    JpegDecoder decoder;
    for (const int width : {64, 3000, 62, 2000, 64}) {
        const auto jpeg = jpeg_from_yuyv(ramp(width, 400).view(), 90);
        const YuyvImage expected = yuyv_from_jpeg(jpeg);
        std::vector<std::uint8_t> to(expected.data.size());
        decoder.decode(jpeg, to);
        EXPECT_EQ(to, expected.data) << width;
    }
}

TEST(ReusedMemory, IsGivenBackForAMuchSmallerImageOnly) {
    std::vector<std::uint8_t> memory;
    fit(memory, 40'000'000);
    const auto* at = memory.data();
    fit(memory, 10'000'000);
    EXPECT_EQ(memory.data(), at);
    EXPECT_EQ(memory.size(), 10'000'000U);
    fit(memory, 9'000'000);
    EXPECT_EQ(memory.size(), 9'000'000U);
    EXPECT_LT(memory.capacity(), 10'000'000U);
}

TEST(Jpeg, PaddingBehindTheImageIsTaken) {
    const YuyvImage image = ramp(64, 48);
    auto bytes = jpeg_from_yuyv(image.view(), 100);
    bytes.insert(bytes.end(), 50, 0);  // as webcams do
    expect_near(yuyv_from_jpeg(bytes), image, 3);
}

}  // namespace
}  // namespace goalmouth
