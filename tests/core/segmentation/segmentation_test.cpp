#include "core/segmentation/segmentation.h"

#include "core/random/random.h"
#include "core/segmentation/transition.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr Ycbcr green{90, 100, 90};
constexpr Ycbcr yellow{170, 50, 150};

/// Yellow where it is nearer to yellow than to green along the way from one to the other.
const ColourTable& two_colour_table() {
    static const ColourTable table = [] {
        ColourTable two(7);
        for (int y = 0; y < 256; y += 2) {
            for (int cb = 0; cb < 256; cb += 2) {
                for (int cr = 0; cr < 256; cr += 2) {
                    const Ycbcr p{static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                                  static_cast<std::uint8_t>(cr)};
                    two.set(p, cb < 75 ? Colour::goal : Colour::field);
                }
            }
        }
        return two;
    }();
    return table;
}

std::uint8_t rounded(double value) {
    return static_cast<std::uint8_t>(std::lround(value));
}

/// 4:2:2 image of yellow(x, y) ∈ [0, 1], the share of yellow in a pixel; chroma is its pair's mean.
YuyvImage render(int width, int height, const std::function<double(int, int)>& share) {
    YuyvImage image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; x += 2) {
            const double a = share(x, y);
            const double b = x + 1 < width ? share(x + 1, y) : a;
            const double mean = 0.5 * (a + b);
            auto* pair = image.data.data() + y * image.stride() + 2 * x;
            pair[0] = rounded(green.y + a * (yellow.y - green.y));
            pair[2] = rounded(green.y + b * (yellow.y - green.y));
            pair[1] = rounded(green.cb + mean * (yellow.cb - green.cb));
            pair[3] = rounded(green.cr + mean * (yellow.cr - green.cr));
        }
    }
    return image;
}

/// Share of a pixel right of an edge blurred by σ, averaged over the pixel.
double blurred(double pixel, double edge, double sigma) {
    double sum = 0.0;
    for (int i = 0; i < 20; ++i)
        sum += 0.5 * std::erfc((edge - (pixel - 0.475 + 0.05 * i)) / (sigma * std::sqrt(2.0)));
    return sum / 20.0;
}

void expect_lines_covered(const Segments& segments) {
    for (const ScanLine& line : segments.lines) {
        const int size = line.orientation == Orientation::horizontal ? segments.width : segments.height;
        int next = 0;
        for (int i = line.first; i < line.first + line.count; ++i) {
            const Segment& s = segments.segments[static_cast<std::size_t>(i)];
            ASSERT_EQ(s.start, next);
            ASSERT_GE(s.end, s.start);
            if (i > line.first) {
                ASSERT_NE(s.colour, segments.segments[static_cast<std::size_t>(i) - 1].colour);
            }
            next = s.end + 1;
        }
        ASSERT_EQ(next, size);
    }
}

TEST(Segmentation, CutsALineWhereTheClassChanges) {
    const YuyvImage image = render(40, 20, [](int x, int) { return x >= 10 && x < 16 ? 1.0 : 0.0; });
    const Segments segments = segment_frame(image.view(), two_colour_table(), {{7}, {12}});
    ASSERT_EQ(segments.lines.size(), 2U);
    EXPECT_EQ(segments.lines[0].orientation, Orientation::horizontal);
    EXPECT_EQ(segments.lines[0].position, 7);
    ASSERT_EQ(segments.lines[0].count, 3);
    const Segment& post = segments.segments[1];
    EXPECT_EQ(post.start, 10);
    EXPECT_EQ(post.end, 15);
    EXPECT_EQ(post.colour, Colour::goal);
    EXPECT_EQ(post.length(), 6);
    EXPECT_FLOAT_EQ(post.centre(), 12.5F);
    EXPECT_EQ(segments.lines[1].orientation, Orientation::vertical);
    ASSERT_EQ(segments.lines[1].count, 1);
    EXPECT_EQ(segments.segments[3].end, 19);
    EXPECT_EQ(segments.segments[3].colour, Colour::goal);
}

TEST(Segmentation, SegmentsCoverEveryLineOfANoiseImage) {
    Random random(5);
    for (const auto& [width, height] : {std::pair{64, 48}, {63, 47}, {1, 1}, {1, 9}, {9, 1}, {2, 2}}) {
        YuyvImage image(width, height);
        for (auto& byte : image.data) byte = static_cast<std::uint8_t>(random.index(256));
        const Segments segments =
            segment_frame(image.view(), two_colour_table(), image_layout(width, height, {}));
        expect_lines_covered(segments);
    }
}

TEST(Segmentation, EveryPixelHasTheTablesClass) {
    Random random(6);
    YuyvImage image(37, 23);
    for (auto& byte : image.data) byte = static_cast<std::uint8_t>(random.index(256));
    const ColourTable table = two_colour_table();
    const Segments segments = segment_frame(image.view(), table, {{0, 5, 22}, {0, 17, 36}});
    ASSERT_EQ(segments.lines.size(), 6U);
    for (const ScanLine& line : segments.lines) {
        for (int i = line.first; i < line.first + line.count; ++i) {
            const Segment& s = segments.segments[static_cast<std::size_t>(i)];
            for (int at = s.start; at <= s.end; ++at) {
                const bool row = line.orientation == Orientation::horizontal;
                EXPECT_EQ(
                    table.at(row ? image.view().at(at, line.position) : image.view().at(line.position, at)),
                    s.colour);
            }
        }
    }
}

TEST(Segmentation, LeavesOutLinesBeyondTheImage) {
    const YuyvImage image(8, 8);
    const Segments segments = segment_frame(image.view(), two_colour_table(), {{-1, 3, 8}, {7, 400}});
    EXPECT_EQ(segments.lines.size(), 2U);
}

TEST(Segmentation, OfAnEmptyImageIsEmpty) {
    const Segments segments = segment_frame({}, two_colour_table(), {{0}, {0}});
    EXPECT_TRUE(segments.lines.empty());
    EXPECT_TRUE(segments.segments.empty());
}

TEST(Segmentation, ReadsImagesWithGapsBetweenRows) {
    const YuyvImage packed = render(20, 6, [](int x, int y) { return x + y >= 12 ? 1.0 : 0.0; });
    std::vector<std::uint8_t> padded(6 * 64, 0x55);
    for (int y = 0; y < 6; ++y) std::copy_n(packed.view().row(y), packed.stride(), padded.begin() + 64 * y);
    const ScanLayout layout{{0, 3, 5}, {2, 13}};
    const Segments a = segment_frame(packed.view(), two_colour_table(), layout);
    const Segments b = segment_frame({padded.data(), 20, 6, 64}, two_colour_table(), layout);
    ASSERT_EQ(a.segments.size(), b.segments.size());
    for (std::size_t i = 0; i < a.segments.size(); ++i)
        EXPECT_EQ(a.segments[i].transition, b.segments[i].transition);
}

struct Errors {
    double mean = 0.0;
    double largest = 0.0;
};

/// Errors of the transition over edges at all fractions of a pixel and of a chroma pair.
Errors transition_errors(Orientation orientation, double sigma, bool entering) {
    Errors errors;
    int count = 0;
    const bool along_row = orientation == Orientation::horizontal;
    for (double edge = 30.0; edge < 32.0; edge += 0.05, ++count) {
        const auto share = [&](int x, int y) {
            const double yellow_share = blurred(along_row ? x : y, edge, sigma);
            return entering ? yellow_share : 1.0 - yellow_share;
        };
        const YuyvImage image = render(60, 60, share);
        const Segments segments = along_row ? segment_frame(image.view(), two_colour_table(), {{20}, {}})
                                            : segment_frame(image.view(), two_colour_table(), {{}, {20}});
        EXPECT_EQ(segments.segments.size(), 2U);
        const double error = segments.segments.back().transition - edge;
        errors.mean += error;
        errors.largest = std::max(errors.largest, std::abs(error));
    }
    errors.mean /= count;
    return errors;
}

TEST(Transition, OfRenderedRampsIsUnbiasedAndBetterThanHalfAPixel) {
    for (const Orientation orientation : {Orientation::horizontal, Orientation::vertical}) {
        for (const double sigma : {0.3, 0.6, 0.85}) {
            for (const bool entering : {true, false}) {
                const Errors errors = transition_errors(orientation, sigma, entering);
                EXPECT_LT(std::abs(errors.mean), 0.05) << "sigma " << sigma << " entering " << entering;
                EXPECT_LT(errors.largest, 0.25) << "sigma " << sigma << " entering " << entering;
            }
        }
    }
}

TEST(Transition, IsWhereTheEdgeIsThoughTheClassChangesElsewhere) {
    // The table may call a mixed pixel by a third name: the boundary moves by a pixel, the edge does not.
    const double edge = 30.3;
    const YuyvImage image = render(60, 4, [&](int x, int) { return blurred(x, edge, 0.6); });
    for (const int boundary : {30, 31, 32}) {
        EXPECT_NEAR(locate_transition(image.view(), Orientation::horizontal, 1, boundary), edge, 0.15)
            << boundary;
    }
}

TEST(Transition, OfAThinPostKeepsItsWidth) {
    for (const double width : {5.0, 6.5, 9.2}) {
        double sum = 0.0;
        int count = 0;
        for (double left = 20.0; left < 22.0; left += 0.1, ++count) {
            const YuyvImage image = render(
                60, 4, [&](int x, int) { return blurred(x, left, 0.5) - blurred(x, left + width, 0.5); });
            const Segments segments = segment_frame(image.view(), two_colour_table(), {{2}, {}});
            ASSERT_EQ(segments.segments.size(), 3U);
            const double found = segments.segments[2].transition - segments.segments[1].transition;
            EXPECT_NEAR(found, width, 1.0);
            sum += found;
        }
        EXPECT_NEAR(sum / count, width, 0.25);
    }
}

TEST(Transition, WithoutContrastIsBetweenThePixels) {
    const YuyvImage image = render(20, 4, [](int, int) { return 0.0; });
    EXPECT_FLOAT_EQ(locate_transition(image.view(), Orientation::horizontal, 1, 7), 6.5F);
}

TEST(Transition, AtTheImageBorderIsTheBorder) {
    const YuyvImage image = render(20, 4, [](int, int) { return 1.0; });
    const Segments segments = segment_frame(image.view(), two_colour_table(), {{1}, {3}});
    for (const Segment& s : segments.segments) EXPECT_FLOAT_EQ(s.transition, -0.5F);
}

TEST(Transition, NeverLeavesWhatAMessageCanHold) {
    Random random(9);
    YuyvImage image(200, 50);
    for (auto& byte : image.data) byte = static_cast<std::uint8_t>(random.index(256));
    const Segments segments = segment_frame(image.view(), two_colour_table(), image_layout(200, 50, {}));
    for (const Segment& s : segments.segments) {
        const double hundredths = 100.0 * (s.transition - s.start + 0.5);
        EXPECT_LE(std::abs(hundredths), 127.01);
        EXPECT_NEAR(hundredths, std::round(hundredths), 2e-3);
    }
}

}  // namespace
}  // namespace goalmouth
