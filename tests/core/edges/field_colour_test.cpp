#include "core/edges/field_colour.h"

#include "tests/core/edges/edge_scene.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

Appearance seen(const Shade& s) {
    return {static_cast<float>(s.y), static_cast<float>(s.cb), static_cast<float>(s.cr)};
}

/// Samples of a picture whose lower `share` is of `below`, the rest of `above`, lit by `light`, with noise.
std::vector<FieldSample> samples(const Shade& above, const Shade& below, double share, double light,
                                 double noise = 2.0) {
    std::mt19937 random(7);
    std::normal_distribution<double> grain(0.0, noise);
    std::vector<FieldSample> all;
    for (int i = 0; i < 2000; ++i) {
        const double down = (i + 0.5) / 2000.0;
        Shade s = (down > 1.0 - share ? below : above) * light;
        s = {s.y + grain(random), s.cb + grain(random), s.cr + grain(random)};
        all.push_back({seen(s), static_cast<float>(down)});
    }
    return all;
}

TEST(FieldColour, IsFoundInAnyLight) {
    for (const double light : {0.15, 0.5, 1.0, 1.6}) {
        const auto field = FieldColourFinder().find(samples(grey, green, 0.6, light), 0.1F);
        ASSERT_TRUE(field) << light;
        EXPECT_TRUE(field->contains(seen(green * light)));
        EXPECT_FALSE(field->contains(seen(white * light)));
        EXPECT_FALSE(field->contains(seen(yellow * light)));
        EXPECT_NEAR(field->luma(), green.y * light, 3.0);
    }
}

TEST(FieldColour, HoldsSunAndShadeTogether) {
    auto both = samples(grey, green, 0.6, 1.0);
    const auto shade = samples(grey, green, 0.6, 0.4);
    both.insert(both.end(), shade.begin(), shade.end());
    const auto field = FieldColourFinder().find(both, 0.1F);
    ASSERT_TRUE(field);
    EXPECT_TRUE(field->contains(seen(green)));
    EXPECT_TRUE(field->contains(seen(green * 0.4)));
}

TEST(FieldColour, IsTheLowerOfTwoGreens) {
    const Shade other{120.0, -45.0, -20.0};
    const auto field = FieldColourFinder().find(samples(other, green, 0.5, 1.0), 0.1F);
    ASSERT_TRUE(field);
    EXPECT_TRUE(field->contains(seen(green)));
    EXPECT_FALSE(field->contains(seen(other)));
}

TEST(FieldColour, IsNothingWhereNothingIsGreenOrTooLittle) {
    EXPECT_FALSE(FieldColourFinder().find({}, 0.1F));
    EXPECT_FALSE(FieldColourFinder().find(samples(grey, white, 0.6, 1.0), 0.1F));
    EXPECT_FALSE(FieldColourFinder().find(samples(grey, {100.0, 60.0, -30.0}, 0.6, 1.0), 0.1F)) << "blue";
    EXPECT_FALSE(FieldColourFinder().find(samples(grey, {0.0, 0.0, 0.0}, 1.0, 1.0, 0.0), 0.1F)) << "black";
    EXPECT_FALSE(FieldColourFinder().find(samples(grey, {5.0, 0.0, 0.0}, 1.0, 1.0, 2.0), 0.1F))
        << "noise in the dark is green, too";
    EXPECT_FALSE(FieldColourFinder().find(samples(grey, green, 0.02, 1.0), 0.1F));
    EXPECT_TRUE(FieldColourFinder().find(samples(grey, green, 0.1, 1.0), 0.1F));
}

}  // namespace
}  // namespace goalmouth
