#include "core/imaging/conversion.h"

#include <random>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

cv::Mat random_image(int width, int height, std::uint64_t seed) {
    cv::Mat image(height, width, CV_8UC3);
    cv::RNG random(seed);
    random.fill(image, cv::RNG::UNIFORM, 0, 256);
    return image;
}

TEST(Conversion, TakesLumaOfEachPixelAndTheMeanChromaOfAPair) {
    const cv::Mat bgr = random_image(16, 8, 1);
    cv::Mat ycrcb;
    cv::cvtColor(bgr, ycrcb, cv::COLOR_BGR2YCrCb);
    const YuyvImage image = yuyv_from_bgr(bgr);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            const auto& here = ycrcb.at<cv::Vec3b>(y, x);
            const auto& partner = ycrcb.at<cv::Vec3b>(y, x ^ 1);
            const Ycbcr p = image.view().at(x, y);
            EXPECT_EQ(p.y, here[0]);
            EXPECT_NEAR(p.cr, (here[1] + partner[1]) / 2.0, 0.5);
            EXPECT_NEAR(p.cb, (here[2] + partner[2]) / 2.0, 0.5);
        }
    }
}

TEST(Conversion, BringsBackColoursThatArePairwiseEqual) {
    cv::Mat bgr = random_image(32, 16, 2);
    for (int y = 0; y < bgr.rows; ++y)
        for (int x = 1; x < bgr.cols; x += 2) bgr.at<cv::Vec3b>(y, x) = bgr.at<cv::Vec3b>(y, x - 1);
    const cv::Mat back = bgr_from_yuyv(yuyv_from_bgr(bgr).view());
    ASSERT_EQ(back.size(), bgr.size());
    // 8-bit YCbCr holds a colour to about one level of each of its three numbers.
    EXPECT_LE(cv::norm(bgr, back, cv::NORM_INF), 3.0);
}

TEST(Conversion, KeepsTheLastPixelOfAnOddRowAlone) {
    const cv::Mat bgr = random_image(5, 3, 3);
    const YuyvImage image = yuyv_from_bgr(bgr);
    EXPECT_EQ(image.width, 5);
    EXPECT_EQ(image.data.size(), 3U * 12U);
    for (int y = 0; y < 3; ++y) {
        const Ycbcr expected = ycbcr_from_bgr(bgr.at<cv::Vec3b>(y, 4));
        const Ycbcr p = image.view().at(4, y);
        EXPECT_EQ(p.y, expected.y);
        EXPECT_EQ(p.cb, expected.cb);
        EXPECT_EQ(p.cr, expected.cr);
    }
    EXPECT_EQ(bgr_from_yuyv(image.view()).size(), bgr.size());
}

TEST(Conversion, OfOnePixel) {
    const cv::Mat bgr(1, 1, CV_8UC3, cv::Scalar(30, 200, 220));
    const cv::Mat back = bgr_from_yuyv(yuyv_from_bgr(bgr).view());
    ASSERT_EQ(back.size(), cv::Size(1, 1));
    EXPECT_LE(cv::norm(bgr, back, cv::NORM_INF), 3.0);
}

TEST(Conversion, OfNothingIsNothing) {
    EXPECT_TRUE(yuyv_from_bgr(cv::Mat()).view().empty());
    EXPECT_TRUE(bgr_from_yuyv(YuyvView{}).empty());
}

TEST(Conversion, ReadsPartsOfLargerImages) {
    const cv::Mat whole = random_image(20, 10, 4);
    const cv::Mat part = whole(cv::Rect(3, 2, 8, 5));
    EXPECT_EQ(yuyv_from_bgr(part).data, yuyv_from_bgr(part.clone()).data);
}

TEST(Conversion, RefusesOtherPixelTypes) {
    EXPECT_THROW(yuyv_from_bgr(cv::Mat(2, 2, CV_8UC1)), std::invalid_argument);
}

TEST(Conversion, KnowsPrimaryColours) {
    // ITU-R BT.601: Y = 0.299 R + 0.587 G + 0.114 B, full range.
    const Ycbcr red = ycbcr_from_bgr({0, 0, 255});
    EXPECT_NEAR(red.y, 76, 1);
    EXPECT_NEAR(red.cb, 85, 1);
    EXPECT_NEAR(red.cr, 255, 1);
    const Ycbcr grey = ycbcr_from_bgr({77, 77, 77});
    EXPECT_EQ(grey.y, 77);
    EXPECT_EQ(grey.cb, 128);
    EXPECT_EQ(grey.cr, 128);
}

}  // namespace
}  // namespace goalmouth
