#include "core/imaging/chroma_shift.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// Luma 10·x + y, Cb 20·pair, Cr 255 − 20·pair.
YuyvImage ramps(int width, int height) {
    YuyvImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int pair = 0; pair < (width + 1) / 2; ++pair) {
            std::uint8_t* p = image.data.data() + y * image.stride() + 4 * pair;
            p[0] = static_cast<std::uint8_t>(20 * pair + y);
            p[1] = static_cast<std::uint8_t>(20 * pair);
            p[2] = static_cast<std::uint8_t>(20 * pair + 10 + y);
            p[3] = static_cast<std::uint8_t>(255 - 20 * pair);
        }
    return image;
}

TEST(ChromaShift, WholePairsMoveAsTheyAre) {
    const YuyvImage image = ramps(12, 2);
    YuyvImage moved;
    for (const int pairs : {-9, -2, 0, 1, 3, 9}) {
        move_chroma_left(image.view(), 2.0 * pairs, moved);
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 12; ++x) {
                const Ycbcr found = moved.view().at(x, y);
                const Ycbcr chroma = image.view().at(2 * std::clamp(x / 2 + pairs, 0, 5), y);
                EXPECT_EQ(found.y, image.view().at(x, y).y);
                EXPECT_EQ(found.cb, chroma.cb) << x << " by " << pairs;
                EXPECT_EQ(found.cr, chroma.cr) << x << " by " << pairs;
            }
    }
}

TEST(ChromaShift, BetweenPairsItIsInterpolated) {
    YuyvImage moved;
    move_chroma_left(ramps(12, 1).view(), -0.5, moved);
    for (int x = 4; x < 10; ++x) {
        EXPECT_EQ(moved.view().at(x, 0).cb, 20 * (x / 2) - 5) << x;
        EXPECT_EQ(moved.view().at(x, 0).cr, 255 - 20 * (x / 2) + 5) << x;
    }
}

TEST(ChromaShift, WhatOvershootsIsCut) {
    YuyvImage step(16, 1);
    for (int pair = 4; pair < 8; ++pair) step.data[static_cast<std::size_t>(4 * pair + 1)] = 255;
    YuyvImage moved;
    move_chroma_left(step.view(), 1.0, moved);
    EXPECT_EQ(moved.view().at(2 * 2, 0).cb, 0);
    EXPECT_NEAR(moved.view().at(2 * 3, 0).cb, 127, 1);
    EXPECT_EQ(moved.view().at(2 * 4, 0).cb, 255);
    EXPECT_EQ(moved.view().at(2 * 7, 0).cb, 255);
}

TEST(ChromaShift, RowsOfOddWidthAndOfAnyStride) {
    const YuyvImage image = ramps(12, 3);
    const YuyvView part{image.data.data() + 4, 7, 3, image.stride()};  // all but the first pair and the last
    YuyvImage moved;
    move_chroma_left(part, 2.0, moved);
    EXPECT_EQ(moved.width, 7);
    EXPECT_EQ(moved.height, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 7; ++x) {
            EXPECT_EQ(moved.view().at(x, y).y, part.at(x, y).y);
            EXPECT_EQ(moved.view().at(x, y).cb, 20 * std::min(x / 2 + 2, 4));
        }
}

}  // namespace
}  // namespace goalmouth
