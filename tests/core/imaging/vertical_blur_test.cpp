#include "core/imaging/vertical_blur.h"

#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(VerticalBlur, SpreadsAPixelOverItsColumnAlone) {
    YuyvImage image(8, 9);
    const auto byte = [&](YuyvImage& of, int row, int i) -> std::uint8_t& {
        return of.data[static_cast<std::size_t>(row * of.stride() + i)];
    };
    byte(image, 4, 5) = 160;  // chroma
    byte(image, 0, 8) = 160;  // luma, in the first row
    YuyvImage blurred;
    blur_vertically(image.view(), blurred);
    ASSERT_EQ(blurred.data.size(), image.data.size());
    const int inside[] = {0, 0, 10, 40, 60, 40, 10, 0, 0}, at_border[] = {110, 50, 10, 0, 0, 0, 0, 0, 0};
    for (int row = 0; row < 9; ++row)
        for (int i = 0; i < image.stride(); ++i)
            EXPECT_EQ(byte(blurred, row, i), i == 5   ? inside[row]
                                             : i == 8 ? at_border[row]
                                                      : 0)
                << row << ", " << i;
}

TEST(VerticalBlur, LeavesWhatIsAlikeFromRowToRow) {
    YuyvImage image(6, 2);  // fewer rows than it looks at
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<std::uint8_t>(i % 12 * 23);
    const YuyvView part{image.data.data(), 3, 2, image.stride()};
    YuyvImage blurred;
    blur_vertically(part, blurred);
    EXPECT_EQ(blurred.width, 3);
    EXPECT_EQ(blurred.height, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            EXPECT_EQ(blurred.view().at(x, y).y, part.at(x, y).y);
            EXPECT_EQ(blurred.view().at(x, y).cr, part.at(x, y).cr);
        }
}

}  // namespace
}  // namespace goalmouth
