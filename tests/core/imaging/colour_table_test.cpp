#include "core/imaging/colour_table.h"

#include <random>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

ColourTable random_table(int bits, unsigned seed) {
    ColourTable table(bits, "random");
    std::mt19937 random(seed);
    for (std::uint8_t& entry : table.entries()) entry = static_cast<std::uint8_t>(random() % colour_count);
    return table;
}

class EachFineness : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(ColourTable, EachFineness, testing::Values(5, 6, 7, 8));

TEST_P(EachFineness, HasTwoToTheThreeNEntriesAllUnclassified) {
    const ColourTable table(GetParam());
    EXPECT_EQ(table.entries().size(), std::size_t{1} << (3 * GetParam()));
    EXPECT_EQ(class_counts(table)[0], table.entries().size());
}

TEST_P(EachFineness, IndexReachesEveryEntryOnce) {
    const ColourTable table(GetParam());
    const int step = 1 << (8 - GetParam());
    std::vector<bool> seen(table.entries().size(), false);
    for (int y = 0; y < 256; y += step)
        for (int cb = 0; cb < 256; cb += step)
            for (int cr = 0; cr < 256; cr += step) {
                const std::size_t i =
                    table.index({static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                                 static_cast<std::uint8_t>(cr)});
                ASSERT_LT(i, seen.size());
                ASSERT_FALSE(seen[i]);
                seen[i] = true;
            }
}

TEST_P(EachFineness, SetsTheWholeCellAndNothingElse) {
    ColourTable table(GetParam());
    const Ycbcr p{200, 60, 150};
    table.set(p, Colour::goal);
    EXPECT_EQ(class_counts(table)[static_cast<std::size_t>(Colour::goal)], 1U);
    EXPECT_EQ(table.at(p), Colour::goal);
    EXPECT_EQ(table.at(cell_centre(p, GetParam())), Colour::goal);
    EXPECT_EQ(table.at({static_cast<std::uint8_t>(p.y ^ 0x80), p.cb, p.cr}), Colour::unclassified);
}

TEST_P(EachFineness, LumaRunsFastestThenCrThenCb) {
    const ColourTable table(GetParam());
    const auto step = static_cast<std::uint8_t>(1 << (8 - GetParam()));
    EXPECT_EQ(table.index({step, 0, 0}), 1U);
    EXPECT_EQ(table.index({0, 0, step}), std::size_t{1} << GetParam());
    EXPECT_EQ(table.index({0, step, 0}), std::size_t{1} << (2 * GetParam()));
}

TEST_P(EachFineness, FinerTablesGiveTheSameClassForEveryColour) {
    const ColourTable table = random_table(GetParam(), 7);
    std::mt19937 random(1);
    for (int bits = GetParam(); bits <= 8; ++bits) {
        const ColourTable finer = resampled(table, bits);
        ASSERT_EQ(finer.bits(), bits);
        for (int i = 0; i < 2000; ++i) {
            const Ycbcr p{static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
                          static_cast<std::uint8_t>(random())};
            ASSERT_EQ(finer.at(p), table.at(p));
        }
    }
}

TEST_P(EachFineness, ComesBackFromAFinerTable) {
    const ColourTable table = random_table(GetParam(), 8);
    for (int bits = GetParam(); bits <= 8; ++bits)
        EXPECT_EQ(resampled(resampled(table, bits), GetParam()), table);
}

TEST(ColourTable, CoarserTakesTheMajority) {
    ColourTable table(6);
    for (int i = 0; i < 5; ++i)  // five of the eight entries of one coarser cell
        table.set({static_cast<std::uint8_t>(4 * (i & 1)), static_cast<std::uint8_t>(4 * ((i >> 1) & 1)),
                   static_cast<std::uint8_t>(4 * (i >> 2))},
                  Colour::ball);
    EXPECT_EQ(resampled(table, 5).at({0, 0, 0}), Colour::ball);
    table.set({0, 0, 0}, Colour::unclassified);  // four and four: the lower number
    EXPECT_EQ(resampled(table, 5).at({0, 0, 0}), Colour::unclassified);
}

TEST(ColourTable, RefusesOtherFinenesses) {
    for (const int bits : {-1, 0, 4, 9}) EXPECT_THROW(ColourTable{bits}, std::invalid_argument) << bits;
}

TEST(ColourTable, RemembersHowItWasMade) {
    ColourTable table(5, "x");
    table.add_provenance("by hand");
    const ColourTable finer = resampled(table, 6);
    ASSERT_EQ(finer.provenance().size(), 2U);
    EXPECT_EQ(finer.provenance()[0], "by hand");
    EXPECT_EQ(resampled(table, 5).provenance().size(), 1U);
}

}  // namespace
}  // namespace goalmouth
