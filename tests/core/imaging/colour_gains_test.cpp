#include "core/imaging/colour_gains.h"

#include "core/imaging/conversion.h"

#include <algorithm>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// Each cube of 64 BGR levels has a class of its own as far as they go.
Colour class_of(const cv::Vec3d& bgr) {
    const int cube =
        static_cast<int>(bgr[0] / 64) + static_cast<int>(bgr[1] / 64) + static_cast<int>(bgr[2] / 64);
    return static_cast<Colour>(cube % colour_count);
}

ColourTable cubes() {
    ColourTable table(8);
    for (int cb = 0; cb < 256; ++cb)
        for (int cr = 0; cr < 256; ++cr)
            for (int y = 0; y < 256; ++y) {
                const double b = y + 1.772 * (cb - 128), r = y + 1.402 * (cr - 128);
                const double g = y - 0.344136 * (cb - 128) - 0.714136 * (cr - 128);
                if (std::min({b, g, r}) < 0 || std::max({b, g, r}) > 255) continue;
                table.set({static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                           static_cast<std::uint8_t>(cr)},
                          class_of({b, g, r}));
            }
    return table;
}

TEST(AdaptedTable, AnswersForTheColourUnderTheGainsAsBefore) {
    const ColourTable base = cubes();
    for (const ColourGains& gains : {ColourGains{0.5, 0.5, 0.5}, ColourGains{1.1, 0.9, 0.6}}) {
        const ColourTable table = adapted(base, gains);
        std::mt19937 random(3);
        int right = 0, asked = 0;
        for (int i = 0; i < 3000; ++i) {
            cv::Vec3d was;
            for (int c = 0; c < 3; ++c) {  // away from the cubes' faces, which rounding crosses
                was[c] = 64.0 * std::uniform_int_distribution<int>(0, 3)(random) +
                         std::uniform_real_distribution<double>(8, 56)(random);
            }
            const cv::Vec3d now(was[0] * gains.blue, was[1] * gains.green, was[2] * gains.red);
            if (now[0] > 255 || now[1] > 255 || now[2] > 255) continue;
            ++asked;
            right += table.at(ycbcr_from_bgr(cv::Vec3b(
                         cv::saturate_cast<std::uint8_t>(now[0]), cv::saturate_cast<std::uint8_t>(now[1]),
                         cv::saturate_cast<std::uint8_t>(now[2])))) == class_of(was);
        }
        EXPECT_GE(right, 0.99 * asked);
        EXPECT_GT(asked, 1000);
    }
}

/// Yellow, orange, green and white things, each with some range about them.
ColourTable things() {
    ColourTable table(6);
    const auto paint = [&](const cv::Vec3d& rgb, Colour colour) {
        for (double brightness = 0.4; brightness <= 1.05; brightness += 0.01)
            for (int r = -24; r <= 24; r += 3)
                for (int g = -24; g <= 24; g += 3)
                    for (int b = -12; b <= 12; b += 3)
                        table.set(ycbcr_from_bgr(
                                      cv::Vec3b(cv::saturate_cast<std::uint8_t>(brightness * (rgb[2] + b)),
                                                cv::saturate_cast<std::uint8_t>(brightness * (rgb[1] + g)),
                                                cv::saturate_cast<std::uint8_t>(brightness * (rgb[0] + r)))),
                                  colour);
    };
    paint({228, 96, 28}, Colour::ball);
    paint({226, 184, 34}, Colour::goal);
    paint({52, 122, 62}, Colour::field);
    for (int y = 190; y < 256; ++y) table.set({static_cast<std::uint8_t>(y), 128, 128}, Colour::line);
    return table;
}

TEST(AdaptedTable, KnowsWhatClips) {
    const ColourTable table = adapted(things(), {3.0, 3.0, 3.0});
    const auto at = [&](int r, int g, int b) {
        return table.at(ycbcr_from_bgr(cv::Vec3b(static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g),
                                                 static_cast<std::uint8_t>(r))));
    };
    EXPECT_EQ(at(255, 255, 102), Colour::goal);
    EXPECT_EQ(at(156, 255, 186), Colour::field);
    EXPECT_EQ(at(130, 255, 155), Colour::field);
    EXPECT_EQ(at(255, 255, 255), Colour::unclassified) << "any grey wall looks like that";
    EXPECT_EQ(at(120, 120, 255), Colour::unclassified);
    EXPECT_EQ(adapted(things(), {1.1, 1.1, 1.1}).at({255, 128, 128}), Colour::line);
    EXPECT_EQ(adapted(things(), {2.0, 3.0, 6.0}).at({255, 128, 128}), Colour::unclassified);
    // In warm light only red clips, and by little: orange is not yellow for that.
    const ColourTable warm = adapted(things(), {1.5, 1.0, 0.6});
    EXPECT_EQ(warm.at(ycbcr_from_bgr(cv::Vec3b(20, 184, 255))), Colour::goal);
}

Colour class_in(const ColourTable& table, int r, int g, int b) {
    return table.at(ycbcr_from_bgr(
        cv::Vec3b(static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(r))));
}

const KnownColours seen_before{Eigen::Vector3d(52, 122, 62), Eigen::Vector3d(226, 184, 34)};

TEST(AdaptedTable, TellsPostsFromTheFieldByBlueAloneWhereBothClip) {
    // Candlelight, so bright that red and green of both come to lie at the end.
    const ColourGains bright{5.5, 3.0, 1.3};
    const ColourTable table = adapted(things(), bright, seen_before);
    for (const int blue : {30, 36, 44, 50}) EXPECT_EQ(class_in(table, 255, 255, blue), Colour::goal) << blue;
    for (const int blue : {72, 80, 90}) EXPECT_EQ(class_in(table, 255, 255, blue), Colour::field) << blue;
    EXPECT_EQ(class_in(table, 255, 255, 200), Colour::unclassified) << "a wall";
    EXPECT_GE(goals_kept(things(), table, bright, seen_before), 0.8);
    EXPECT_LE(goals_kept(things(), ColourTable(6), bright, seen_before), 0.0);
    EXPECT_LE(goals_kept(things(), ColourTable(6), bright, {}), 0.0);
}

TEST(AdaptedTable, KeepsPostsInAnyLight) {
    for (const ColourGains& gains :
         {ColourGains{0.3, 0.3, 0.3}, ColourGains{0.5, 0.3, 0.13}, ColourGains{0.2, 0.3, 0.6},
          ColourGains{1.1, 1.0, 0.9}, ColourGains{3.0, 3.0, 3.0}, ColourGains{1.9, 3.0, 6.0}}) {
        EXPECT_GE(goals_kept(things(), adapted(things(), gains, seen_before), gains, seen_before), 0.8)
            << gains.red << " " << gains.blue;
        const Eigen::Vector3d field =
            seen_before.field->cwiseProduct(Eigen::Vector3d(gains.red, gains.green, gains.blue))
                .cwiseMin(255.0);
        EXPECT_EQ(class_in(adapted(things(), gains, seen_before), static_cast<int>(field.x()),
                           static_cast<int>(field.y()), static_cast<int>(field.z())),
                  Colour::field)
            << gains.red << " " << gains.blue;
    }
    EXPECT_EQ(goals_kept(ColourTable(6), ColourTable(6), {2.0, 2.0, 2.0}, {}), 1.0) << "no goal to keep";
}

TEST(AdaptedTable, WhatIsKnownOfOneThingAloneOrOfDullPostsDecidesNothing) {
    const ColourGains gains{3.0, 3.0, 3.0};
    const ColourTable without = adapted(things(), gains);
    EXPECT_TRUE(adapted(things(), gains, {seen_before.field, std::nullopt}) == without);
    EXPECT_TRUE(adapted(things(), gains, {std::nullopt, seen_before.goal}) == without);
    EXPECT_TRUE(adapted(things(), gains, {seen_before.field, Eigen::Vector3d(232, 233, 228)}) == without);
}

TEST(AdaptedTable, SaturatedColoursKeepTheirClassWhereLightHardlyChanges) {
    ColourTable base = things();
    for (int y = 0; y < 256; y += 4)
        for (int cb = 0; cb < 256; cb += 4)
            for (int cr = 200; cr < 256; cr += 4)
                base.set({static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                          static_cast<std::uint8_t>(cr)},
                         y / 16 % 2 == 0 ? Colour::ball : Colour::goal);
    const ColourTable table = adapted(base, {1.001, 1.001, 1.001});
    for (int y = 2; y < 256; y += 16)
        for (const int cb : {90, 110})
            EXPECT_EQ(table.at({static_cast<std::uint8_t>(y + 6), static_cast<std::uint8_t>(cb), 230}),
                      base.at({static_cast<std::uint8_t>(y + 6), static_cast<std::uint8_t>(cb), 230}))
                << y;
}

TEST(AdaptedTable, IsFinerInTheDark) {
    EXPECT_EQ(adapted(ColourTable(6), {0.5, 0.5, 0.5}).bits(), 7);
    EXPECT_EQ(adapted(ColourTable(6), {0.9, 0.9, 0.9}).bits(), 6);
    EXPECT_EQ(adapted(ColourTable(8), {0.5, 0.5, 0.5}).bits(), 8);
}

TEST(AdaptedTable, WithoutAChangeIsTheTable) {
    ColourTable base(6, "t");
    base.set({10, 20, 30}, Colour::ball);
    base.add_provenance("somehow");
    const ColourTable same = adapted(base, {});
    EXPECT_TRUE(same == base);
    const ColourTable other = adapted(base, {0.9, 1.0, 1.0});
    EXPECT_EQ(other.name(), "t");
    EXPECT_EQ(other.provenance(), base.provenance());
}

}  // namespace
}  // namespace goalmouth
