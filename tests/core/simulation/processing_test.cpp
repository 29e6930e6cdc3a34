#include "core/simulation/processing.h"

#include "core/random/random.h"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

YuyvImage image_of(int width, int height, const std::function<Ycbcr(int, int)>& colour) {
    YuyvImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int pair = 0; pair < (width + 1) / 2; ++pair) {
            std::uint8_t* out = image.data.data() + y * image.stride() + 4 * pair;
            const Ycbcr one = colour(2 * pair, y);
            const Ycbcr other = colour(std::min(2 * pair + 1, width - 1), y);
            out[0] = one.y;
            out[1] = one.cb;
            out[2] = other.y;
            out[3] = one.cr;
        }
    return image;
}

YuyvImage processed(YuyvImage image, const ProcessingParameters& parameters) {
    Processing processing(parameters, image.width, image.height);
    processing.run(image.data.data(), image.stride());
    return image;
}

TEST(Processing, OffChangesNothing) {
    const YuyvImage image = image_of(33, 9, [](int x, int y) {
        return Ycbcr{static_cast<std::uint8_t>(7 * x + y), 90, 160};
    });
    EXPECT_EQ(processed(image, {}).data, image.data);
}

TEST(Processing, SharpeningLeavesFlatAndSlopesAlone) {
    const YuyvImage flat = image_of(31, 9, [](int, int) { return Ycbcr{137, 90, 160}; });
    EXPECT_EQ(processed(flat, {.sharpening = 2.0}).data, flat.data);
    const YuyvImage slope = image_of(32, 9, [](int x, int y) {
        return Ycbcr{static_cast<std::uint8_t>(20 + 5 * x + 3 * y), 90, 160};
    });
    const YuyvImage sharp = processed(slope, {.sharpening = 1.5});
    for (int y = 1; y < 8; ++y)
        for (int x = 1; x < 31; ++x) EXPECT_EQ(sharp.view().at(x, y).y, slope.view().at(x, y).y);
}

TEST(Processing, SharpeningOvershootsAStepByAThirdOfItsShare) {
    for (const bool upright : {true, false}) {
        const YuyvImage step = image_of(20, 20, [&](int x, int y) {
            return Ycbcr{static_cast<std::uint8_t>((upright ? x : y) < 10 ? 60 : 150), 90, 160};
        });
        const YuyvImage sharp = processed(step, {.sharpening = 0.8});
        const auto at = [&](int k) { return upright ? sharp.view().at(k, 9).y : sharp.view().at(9, k).y; };
        EXPECT_EQ(at(8), 60);
        // Three of the nine neighbours lie beyond the step of 90 levels.
        EXPECT_EQ(at(9), 60 - 24);
        EXPECT_EQ(at(10), 150 + 24);
        EXPECT_EQ(at(11), 150);
        EXPECT_EQ(sharp.view().at(9, 9).cb, 90);
        EXPECT_EQ(sharp.view().at(9, 9).cr, 160);
    }
}

TEST(Processing, SharpeningIsClamped) {
    const YuyvImage step = image_of(20, 8, [](int x, int) {
        return Ycbcr{static_cast<std::uint8_t>(x < 10 ? 10 : 245), 128, 128};
    });
    const YuyvImage sharp = processed(step, {.sharpening = 4.0});
    EXPECT_EQ(sharp.view().at(9, 4).y, 0);
    EXPECT_EQ(sharp.view().at(10, 4).y, 255);
}

TEST(Processing, SharpeningUsesLumaAsItWas) {
    // A single bright pixel: each neighbour loses a ninth of its share, whatever order pixels are taken in.
    const YuyvImage dot = image_of(9, 9, [](int x, int y) {
        return Ycbcr{static_cast<std::uint8_t>(x == 4 && y == 4 ? 190 : 100), 128, 128};
    });
    const YuyvImage sharp = processed(dot, {.sharpening = 1.0});
    for (int y = 2; y < 7; ++y)
        for (int x = 2; x < 7; ++x) {
            const bool centre = x == 4 && y == 4;
            const bool beside = !centre && std::abs(x - 4) <= 1 && std::abs(y - 4) <= 1;
            EXPECT_EQ(sharp.view().at(x, y).y, centre ? 255 : beside ? 90 : 100) << x << " " << y;
        }
}

TEST(Processing, TheRimIsSharpenedAsIfItWentOn) {
    const YuyvImage image = image_of(5, 4, [](int x, int) {
        return Ycbcr{static_cast<std::uint8_t>(x < 1 ? 100 : 130), 128, 128};
    });
    const YuyvImage sharp = processed(image, {.sharpening = 1.0});
    for (int y = 0; y < 4; ++y) {
        EXPECT_EQ(sharp.view().at(0, y).y, 90);
        EXPECT_EQ(sharp.view().at(1, y).y, 140);
        EXPECT_EQ(sharp.view().at(4, y).y, 130);
    }
}

/// Root mean square change of luma.
double change(const YuyvImage& a, const YuyvImage& b) {
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const double d = a.view().at(x, y).y - b.view().at(x, y).y;
            sum += d * d;
        }
    return std::sqrt(sum / (a.width * a.height));
}

YuyvImage picture(int width, int height) {
    return image_of(width, height, [](int x, int y) {
        const bool post = x > 20 && x < 32;
        const auto grain = static_cast<int>(random_for_frame(1, "grain", 1000 * y + x).index(9)) - 4;
        return post ? Ycbcr{static_cast<std::uint8_t>(176 + grain), 48, 164}
                    : Ycbcr{static_cast<std::uint8_t>(96 + grain), 108, 96};
    });
}

TEST(Processing, JpegLosesMoreAtLowerQuality) {
    const YuyvImage raw = picture(64, 48);
    double last = 0.0;
    for (const int quality : {95, 80, 50, 20}) {
        const YuyvImage sent = processed(raw, {.mjpeg_quality = quality});
        EXPECT_EQ(sent.data.size(), raw.data.size());
        EXPECT_GT(change(raw, sent), last) << quality;
        last = change(raw, sent);
        if (quality == 95) {
            EXPECT_LT(last, 2.0);
        }
    }
    EXPECT_GT(last, 2.5);
}

TEST(Processing, OddSizesAndWideRowsStayAsTheyAre) {
    const YuyvImage raw = picture(61, 35);
    const int stride = raw.stride() + 12;
    std::vector<std::uint8_t> frame(static_cast<std::size_t>(stride) * 35U, 7);
    for (int y = 0; y < 35; ++y)
        std::copy_n(raw.data.data() + y * raw.stride(), raw.stride(), frame.data() + y * stride);
    Processing processing({.sharpening = 0.5, .mjpeg_quality = 90}, 61, 35);
    processing.run(frame.data(), stride);
    const YuyvView wide{frame.data(), 61, 35, stride};
    const YuyvImage packed = processed(raw, {.sharpening = 0.5, .mjpeg_quality = 90});
    for (int y = 0; y < 35; ++y) {
        for (int x = 0; x < 61; ++x) {
            ASSERT_EQ(wide.at(x, y).y, packed.view().at(x, y).y);
            ASSERT_EQ(wide.at(x, y).cb, packed.view().at(x, y).cb);
            ASSERT_EQ(wide.at(x, y).cr, packed.view().at(x, y).cr);
            ASSERT_NEAR(wide.at(x, y).cb, raw.view().at(x, y).cb, 40);
        }
        for (int i = raw.stride(); i < stride; ++i)
            ASSERT_EQ(frame[static_cast<std::size_t>(y * stride + i)], 7);
    }
}

TEST(Processing, WhatTheCodecCannotDoIsAnError) {
    YuyvImage image(70000, 2);  // wider than a JPEG can be
    Processing processing({.mjpeg_quality = 80}, image.width, image.height);
    try {
        processing.run(image.data.data(), image.stride());
        FAIL() << "a JPEG of 70000 columns";
    } catch (const std::runtime_error& error) {
        EXPECT_GT(std::string(error.what()).size(), 15U) << error.what();
    }
}

}  // namespace
}  // namespace goalmouth
