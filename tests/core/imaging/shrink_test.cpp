#include "core/imaging/shrink.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

void set(YuyvImage& image, int x, int y, Ycbcr p) {
    std::uint8_t* pair = image.data.data() + y * image.stride() + 4 * (x / 2);
    pair[2 * (x & 1)] = p.y;
    pair[1] = p.cb;
    pair[3] = p.cr;
}

TEST(Shrunk, EachPixelIsTheMeanOfItsBlock) {
    YuyvImage image(13, 7);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 13; ++x)
            set(image, x, y,
                {static_cast<std::uint8_t>(10 * x + y), static_cast<std::uint8_t>(100 + x / 2),
                 static_cast<std::uint8_t>(200 - y)});
    const YuyvImage small = shrunk(image.view(), 3);
    ASSERT_EQ(small.width, 4);
    ASSERT_EQ(small.height, 2);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 4; ++x) {
            const Ycbcr p = small.view().at(x, y);
            EXPECT_EQ(p.y, 10 * (3 * x + 1) + 3 * y + 1);
            EXPECT_EQ(p.cb, 100 + 3 * (x / 2) + 1);
            EXPECT_EQ(p.cr, 200 - (3 * y + 1));
        }
    }
}

TEST(Shrunk, ByOneItIsTheSame) {
    YuyvImage image(5, 3);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::uint8_t>(i);
    const YuyvImage same = shrunk(image.view(), 1);
    EXPECT_EQ(same.width, 5);
    EXPECT_EQ(same.data, image.data);
}

TEST(Shrunk, NeverBelowAPair) {
    const YuyvImage tiny(2, 1);
    EXPECT_EQ(shrunk(tiny.view(), 7).width, 2);
    EXPECT_EQ(shrink_factor(YuyvImage(1280, 960).view(), 640), 2);
    EXPECT_EQ(shrink_factor(YuyvImage(641, 480).view(), 640), 2);
    EXPECT_EQ(shrink_factor(YuyvImage(640, 480).view(), 640), 1);
    EXPECT_EQ(shrink_factor(YuyvImage(2000, 1).view(), 640), 1);
}

}  // namespace
}  // namespace goalmouth
