#include "core/imaging/colour_rules.h"

#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Ycbcr rgb(double r, double g, double b) {
    return ycbcr_from_bgr({cv::saturate_cast<std::uint8_t>(b), cv::saturate_cast<std::uint8_t>(g),
                           cv::saturate_cast<std::uint8_t>(r)});
}

TEST(ChromaPolar, PutsFamiliarColoursInOrder) {
    EXPECT_NEAR(chroma_polar(rgb(255, 0, 0)).hue, 109, 3);
    EXPECT_NEAR(chroma_polar(rgb(255, 128, 0)).hue, 135, 8);
    EXPECT_NEAR(chroma_polar(rgb(255, 255, 0)).hue, 171, 3);
    EXPECT_NEAR(chroma_polar(rgb(0, 255, 0)).hue, 231, 3);
    EXPECT_NEAR(chroma_polar(rgb(0, 0, 255)).hue, 351, 3);
    EXPECT_EQ(chroma_polar({77, 128, 128}).chroma, 0.0);
}

TEST(ChromaPolar, HueAndSaturationOutlastShading) {
    const ChromaPolar lit = chroma_polar(rgb(226, 184, 34));
    const ChromaPolar dark = chroma_polar(rgb(0.5 * 226, 0.5 * 184, 0.5 * 34));
    EXPECT_NEAR(lit.hue, dark.hue, 1.5);
    EXPECT_NEAR(lit.saturation, dark.saturation, 0.02);
    EXPECT_NEAR(lit.chroma, 2.0 * dark.chroma, 2.0);
}

TEST(ColourRule, ABoundLeftAloneLetsEverythingPass) {
    const ColourRule rule;
    for (const Ycbcr p : {Ycbcr{0, 0, 0}, Ycbcr{255, 255, 255}, Ycbcr{128, 128, 128}, Ycbcr{0, 255, 0}})
        EXPECT_TRUE(rule.fits(p));
}

TEST(ColourRule, BoundsAreInclusive) {
    ColourRule rule;
    rule.y = {10, 20};
    EXPECT_TRUE(rule.fits({10, 128, 128}));
    EXPECT_TRUE(rule.fits({20, 128, 128}));
    EXPECT_FALSE(rule.fits({9, 128, 128}));
    EXPECT_FALSE(rule.fits({21, 128, 128}));
}

TEST(ColourRule, HueMayRunThroughZero) {
    ColourRule rule;
    rule.hue = {340, 20};
    EXPECT_TRUE(rule.fits({128, 228, 128}));  // 0°
    EXPECT_TRUE(rule.fits({128, 228, 110}));  // 350°
    EXPECT_FALSE(rule.fits({128, 28, 128}));  // 180°
}

TEST(ColourRules, TheFirstThatFitsWins) {
    std::vector<ColourRule> rules(2);
    rules[0].colour = Colour::goal;
    rules[0].cb = {0, 100};
    rules[1].colour = Colour::field;
    const ColourTable table = table_from_rules(rules, 6, "t");
    EXPECT_EQ(table.at({100, 50, 128}), Colour::goal);
    EXPECT_EQ(table.at({100, 150, 128}), Colour::field);
    EXPECT_EQ(table.name(), "t");
}

/// The shipped table against the colours the simulator paints, darkened and with the noise its sensor adds.
TEST(SimulatorTable, HoldsUnderShadingAndNoise) {
    const ColourTable table =
        load_colour_table(std::string(GOALMOUTH_SOURCE_DIR) + "/config/colours/simulator.gmct");
    struct Case {
        double r, g, b;
        double darkest;
        Colour colour;
    };
    const std::vector<Case> cases = {{52, 122, 62, 0.7, Colour::field},
                                     {226, 228, 222, 0.85, Colour::line},
                                     {228, 96, 28, 0.6, Colour::ball},
                                     {226, 184, 34, 0.6, Colour::goal}};
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 6.0);
    for (const Case& c : cases) {
        for (const double light : {c.darkest, 0.85, 1.0, 1.05}) {
            int right = 0;
            for (int i = 0; i < 500; ++i) {
                const Ycbcr a = rgb(light * c.r + noise(random), light * c.g + noise(random),
                                    light * c.b + noise(random));
                const Ycbcr b = rgb(light * c.r + noise(random), light * c.g + noise(random),
                                    light * c.b + noise(random));
                const Ycbcr shared{a.y, static_cast<std::uint8_t>((a.cb + b.cb) / 2),
                                   static_cast<std::uint8_t>((a.cr + b.cr) / 2)};
                right += table.at(shared) == c.colour;
            }
            EXPECT_GE(right, 490) << colour_names[static_cast<std::size_t>(c.colour)] << " at light "
                                  << light;
        }
    }
}

TEST(SimulatorTable, TakesNothingOfTheHallForAGoal) {
    const ColourTable table =
        load_colour_table(std::string(GOALMOUTH_SOURCE_DIR) + "/config/colours/simulator.gmct");
    for (const Ycbcr p :
         {rgb(186, 186, 190), rgb(112, 108, 110), rgb(34, 52, 110), rgb(150, 32, 38), rgb(120, 78, 58),
          rgb(30, 30, 34), rgb(196, 170, 160), rgb(40, 96, 118), rgb(0, 0, 0), rgb(255, 255, 255)})
        EXPECT_NE(table.at(p), Colour::goal);
}

}  // namespace
}  // namespace goalmouth
