#include "core/colour_teaching/colour_mark.h"

#include "core/imaging/conversion.h"

#include <stdexcept>

#include <climits>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

/// 40×30: grey, with a yellow post in columns 10 to 17 and the same yellow apart from it in columns 30 to 33.
/// Below row 20 the post lies in shade.
YuyvImage post_picture() {
    YuyvImage image(40, 30);
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 40; ++x) {
            const bool post = (x >= 10 && x < 18) || (x >= 30 && x < 34);
            std::uint8_t* pair = image.data.data() + y * image.stride() + 4 * (x / 2);
            pair[2 * (x & 1)] = static_cast<std::uint8_t>(post ? (y < 20 ? 170 : 150) : 120);
            pair[1] = post ? 50 : 128;
            pair[3] = post ? 150 : 128;
        }
    }
    return image;
}

std::size_t count(const MarkShape& shape) {
    const YuyvImage image = post_picture();
    return pixels_of(colours_of(marked_pixels(shape, image.view()), image.view()));
}

TEST(ColourMark, ABoxHoldsItsCornersAndNothingElse) {
    const YuyvImage image = post_picture();
    const MarkedPixels pixels = marked_pixels(MarkedBox{{10, 5, 3, 2}}, image.view());
    EXPECT_EQ(cv::countNonZero(pixels.mask), 6);
    EXPECT_TRUE(pixels.holds({10, 5}));
    EXPECT_TRUE(pixels.holds({12, 6}));
    EXPECT_FALSE(pixels.holds({13, 6}));
    EXPECT_FALSE(pixels.holds({9, 5}));
    const auto colours = colours_of(pixels, image.view());
    ASSERT_EQ(colours.size(), 1U) << "each once";
    EXPECT_EQ(colours[0].colour.cb, 50);
    EXPECT_EQ(colours[0].pixels, 6U);
}

TEST(ColourMark, APolygonHoldsWhatItsOutlineGoesAround) {
    const YuyvImage image = post_picture();
    const MarkedPixels triangle = marked_pixels(MarkedPolygon{{{2, 2}, {12, 2}, {2, 12}}}, image.view());
    EXPECT_EQ(triangle.where, cv::Rect(2, 2, 11, 11));
    EXPECT_EQ(cv::countNonZero(triangle.mask), 11 * 12 / 2);
    EXPECT_TRUE(triangle.holds({3, 9}));
    EXPECT_FALSE(triangle.holds({10, 10}));
}

TEST(ColourMark, AFillTakesWhatIsJoinedAndLike) {
    EXPECT_EQ(count(MarkedFill{{12, 3}, 5}), 8U * 20U);   // 20 levels of shade are more than 3·5
    EXPECT_EQ(count(MarkedFill{{12, 3}, 7}), 8U * 30U);   // not more than 3·7: the whole post, not the other
    EXPECT_EQ(count(MarkedFill{{12, 25}, 7}), 8U * 30U);  // from the shade likewise
    EXPECT_EQ(count(MarkedFill{{12, 3}, 100}), 40U * 30U);  // everything is like it
    EXPECT_EQ(count(MarkedFill{{39, 29}, 0}),
              6U * 30U);  // what lies apart is not joined
}

TEST(ColourMark, AFillDoesNotPassWhereOnlyCornersTouch) {
    YuyvImage board(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            std::uint8_t* pair = board.data.data() + y * board.stride() + 4 * (x / 2);
            pair[2 * (x & 1)] = (x < 4) == (y < 4) ? 200 : 50;
            pair[1] = pair[3] = 128;
        }
    EXPECT_EQ(marked_pixels(MarkedFill{{1, 1}, 5}, board.view()).where, cv::Rect(0, 0, 4, 4));
}

/// Each pixel is compared with the seed, not with its neighbour: a slow change of colour ends somewhere.
TEST(ColourMark, AFillDoesNotCreepAlongAGradient) {
    YuyvImage ramp(200, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 200; ++x) {
            std::uint8_t* pair = ramp.data.data() + y * ramp.stride() + 4 * (x / 2);
            pair[2 * (x & 1)] = static_cast<std::uint8_t>(x);
            pair[1] = pair[3] = 128;
        }
    const MarkedPixels pixels = marked_pixels(MarkedFill{{50, 0}, 4}, ramp.view());
    EXPECT_EQ(pixels.where, cv::Rect(50 - 12, 0, 25, 2));
}

TEST(ColourMark, ShapesAPictureCannotHaveAreToldWhy) {
    const cv::Size size(40, 30);
    EXPECT_EQ(shape_problem(MarkedBox{{0, 0, 40, 30}}, size), "");
    EXPECT_EQ(shape_problem(MarkedBox{{0, 0, 41, 30}}, size),
              "the box reaches beyond the picture, which is 40x30");
    EXPECT_NE(shape_problem(MarkedBox{{-1, 0, 4, 3}}, size), "");
    EXPECT_NE(shape_problem(MarkedBox{{1, 1, 0, 3}}, size), "");
    EXPECT_NE(shape_problem(MarkedPolygon{{{0, 0}, {5, 5}}}, size), "");
    EXPECT_NE(shape_problem(MarkedPolygon{{{0, 0}, {5, 5}, {INT_MAX, INT_MAX}}}, size), "");
    EXPECT_NE(shape_problem(MarkedFill{{40, 3}, 5}, size), "");
    EXPECT_NE(shape_problem(MarkedFill{{4, 3}, -1}, size), "");
    EXPECT_NE(shape_problem(MarkedFill{{4, 3}, 101}, size), "");
    const YuyvImage image = post_picture();
    EXPECT_THROW(marked_pixels(MarkedFill{{40, 3}, 5}, image.view()), std::invalid_argument);
}

}  // namespace
}  // namespace goalmouth
