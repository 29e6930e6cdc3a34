#include "core/random/random.h"
#include "core/segmentation/segmentation.h"
#include "tests/core/segmentation/guarded_image.h"
#include "tests/reference/naive_segmentation.h"
#include "tests/support/allocations.h"
#include "tests/support/vector_targets.h"

#include <bit>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::GuardedImage;
using test::on_each_vector_target;

int random_int(Random& random, int lowest, int highest) {
    return lowest + static_cast<int>(random.index(static_cast<std::uint32_t>(highest - lowest + 1)));
}

std::uint8_t random_byte(Random& random) {
    return static_cast<std::uint8_t>(random.index(256));
}

/// Tables of all kinds: any byte anywhere, a few classes anywhere, boxes of classes.
ColourTable random_table(Random& random, int bits) {
    ColourTable table(bits);
    const auto kind = random.index(3);
    if (kind < 2) {
        const std::uint32_t classes = kind == 0 ? 256 : 2 + random.index(5);
        for (auto& entry : table.entries()) entry = static_cast<std::uint8_t>(random.index(classes));
        return table;
    }
    const std::size_t side = std::size_t{1} << bits;
    for (int box = 0; box < 8; ++box) {
        std::size_t from[3];
        for (auto& each : from) each = random.index(static_cast<std::uint32_t>(side));
        const std::uint8_t colour = static_cast<std::uint8_t>(random.index(colour_count));
        for (std::size_t cb = from[0]; cb < std::min(side, from[0] + side / 3); ++cb)
            for (std::size_t cr = from[1]; cr < std::min(side, from[1] + side / 3); ++cr)
                for (std::size_t y = from[2]; y < std::min(side, from[2] + side / 2); ++y)
                    table.entries()[(cb << (2 * bits)) | (cr << bits) | y] = colour;
    }
    return table;
}

/// Pixels of all kinds: noise, few values (so that edges fall on round fractions of a pixel), patches with
/// some noise, one colour.
void fill(Random& random, GuardedImage& image) {
    const auto kind = random.index(4);
    const int patch = random_int(random, 2, 40);
    std::vector<std::uint8_t> patches(4096);
    for (auto& each : patches) each = random_byte(random);
    const int noise = random_int(random, 0, 6);
    for (int y = 0; y < image.height(); ++y) {
        std::uint8_t* row = image.row(y);
        for (int i = 0; i < yuyv_row_bytes(image.width()); ++i) {
            const auto cell = static_cast<std::size_t>(4 * (97 * (y / patch) + i / 4 / patch) + i % 4);
            switch (kind) {
                case 0:
                    row[i] = random_byte(random);
                    break;
                case 1:
                    row[i] = static_cast<std::uint8_t>(96 + 16 * random.index(3));
                    break;
                case 2:
                    row[i] = static_cast<std::uint8_t>(patches[cell % patches.size()] / 2 +
                                                       random_int(random, 0, noise));
                    break;
                default:
                    row[i] = 77;
            }
        }
    }
}

/// Any lines, ascending, a few of them outside the image.
std::vector<int> random_lines(Random& random, int size) {
    std::vector<int> lines;
    const int widest = 1 + static_cast<int>(random.index(40));
    for (int at = random_int(random, -3, 12); at < size + 4; at += random_int(random, 1, widest))
        lines.push_back(at);
    if (random.index(8) == 0) lines.clear();
    return lines;
}

void expect_same(const Segments& found, const Segments& expected) {
    EXPECT_EQ(found.width, expected.width);
    EXPECT_EQ(found.height, expected.height);
    ASSERT_EQ(found.lines.size(), expected.lines.size());
    for (std::size_t i = 0; i < found.lines.size(); ++i) {
        const ScanLine& a = found.lines[i];
        const ScanLine& b = expected.lines[i];
        ASSERT_EQ(std::tie(a.orientation, a.position, a.first, a.count),
                  std::tie(b.orientation, b.position, b.first, b.count))
            << "line " << i;
    }
    ASSERT_EQ(found.segments.size(), expected.segments.size());
    for (std::size_t i = 0; i < found.segments.size(); ++i) {
        const Segment& a = found.segments[i];
        const Segment& b = expected.segments[i];
        ASSERT_EQ(std::tie(a.start, a.end, a.colour), std::tie(b.start, b.end, b.colour)) << "segment " << i;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(a.transition), std::bit_cast<std::uint32_t>(b.transition))
            << "segment " << i << " from " << a.start << ": " << a.transition << " or " << b.transition;
    }
}

void expect_naive_result_on_each_target(YuyvView image, const ColourTable& table, const ScanLayout& layout) {
    const Segments expected = segment_frame_naively(image, table, layout);
    on_each_vector_target([&] { expect_same(segment_frame(image, table, layout), expected); });
}

TEST(Segmenter, AnswersAsTheNaiveVersionWhateverTheImageTableAndLayout) {
    Random random(11);
    for (int i = 0; i < 240; ++i) {
        SCOPED_TRACE(i);
        const bool tiny = i % 3 == 0;
        GuardedImage image(random_int(random, 1, tiny ? 9 : 260), random_int(random, 1, tiny ? 9 : 90),
                           static_cast<int>(random.index(2) * random.index(70)));
        fill(random, image);
        const ColourTable table = random_table(random, random_int(random, 5, i % 40 == 0 ? 8 : 7));
        const ScanLayout layout{random_lines(random, image.height()), random_lines(random, image.width())};
        expect_naive_result_on_each_target(image.view(), table, layout);
        if (HasFatalFailure()) return;
    }
}

TEST(Segmenter, AnswersAsTheNaiveVersionOnWholeFrames) {
    Random random(12);
    for (const auto& [width, height] : {std::pair{1600, 1200}, {641, 479}, {16384, 5}, {3, 16384}}) {
        for (const int spacing : {1, 8}) {
            GuardedImage image(width, height);
            fill(random, image);
            const ColourTable table = random_table(random, 6);
            ScanLineParameters parameters;
            parameters.row_spacing = parameters.column_spacing = spacing;
            expect_naive_result_on_each_target(image.view(), table, image_layout(width, height, parameters));
        }
    }
}

TEST(Segmenter, TakesRowsThatLieMegabytesApart) {
    Random random(13);
    GuardedImage image(9, 21, (1 << 25));
    for (int y = 0; y < image.height(); ++y)
        for (int i = 0; i < yuyv_row_bytes(image.width()); ++i) image.row(y)[i] = random_byte(random);
    const ColourTable table = random_table(random, 5);
    expect_naive_result_on_each_target(image.view(), table, {{0, 3, 20}, {0, 3, 8}});
}

TEST(Segmenter, TakesLinesInAnyOrderAndTwice) {
    Random random(14);
    GuardedImage image(75, 50);
    fill(random, image);
    expect_naive_result_on_each_target(image.view(), random_table(random, 6),
                                       {{40, 900, 3, 3, -1, 49, 0}, {70, 2, -5, 2, 74, 75, 1}});
}

TEST(Segmenter, RemembersNothingOfEarlierFrames) {
    Random random(15);
    const ColourTable table = random_table(random, 6);
    Segmenter segmenter(table);
    for (int i = 0; i < 60; ++i) {
        GuardedImage image(random_int(random, 1, 200), random_int(random, 1, 80));
        fill(random, image);
        const ScanLayout layout{random_lines(random, image.height()), random_lines(random, image.width())};
        expect_same(segmenter.segment(image.view(), layout),
                    segment_frame_naively(image.view(), table, layout));
    }
    EXPECT_TRUE(segmenter.segment({}, {{0}, {0}}).lines.empty());
}

TEST(Segmenter, KeepsItsOwnTable) {
    Random random(16);
    GuardedImage image(60, 40);
    fill(random, image);
    ColourTable table = random_table(random, 6);
    const ScanLayout layout{{5, 20}, {7, 30}};
    const Segments expected = segment_frame_naively(image.view(), table, layout);
    Segmenter segmenter(table);
    table = ColourTable(5);
    expect_same(segmenter.segment(image.view(), layout), expected);
}

TEST(Segmenter, AllocatesNothingOnceWarm) {
    if (!test::allocations_are_counted()) GTEST_SKIP() << "skipped: allocations are not counted here";
    Random random(17);
    const ColourTable table = random_table(random, 6);
    Segmenter segmenter(table);
    const ScanLayout layout = image_layout(320, 240, {});
    GuardedImage noise(320, 240);
    for (int y = 0; y < noise.height(); ++y)
        for (int i = 0; i < yuyv_row_bytes(noise.width()); ++i) noise.row(y)[i] = random_byte(random);
    segmenter.segment(noise.view(), layout);
    for (int i = 0; i < 20; ++i) {
        GuardedImage image(random_int(random, 1, 320), random_int(random, 1, 240));
        fill(random, image);
        const test::AllocationCount count;
        segmenter.segment(image.view(), layout);
        EXPECT_EQ(count.so_far(), 0U) << "frame " << i;
    }
    const test::AllocationCount count;
    segmenter.segment(noise.view(), layout);
    EXPECT_EQ(count.so_far(), 0U);
}

TEST(AllocationCount, SeesTheHeapBeingAsked) {
    if (!test::allocations_are_counted()) GTEST_SKIP() << "skipped: allocations are not counted here";
    const test::AllocationCount count;
    EXPECT_EQ(count.so_far(), 0U);
    std::vector<std::string> strings(3, std::string(100, 'x'));
    EXPECT_GE(count.so_far(), 4U);
}

}  // namespace
}  // namespace goalmouth
