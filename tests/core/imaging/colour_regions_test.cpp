#include "core/imaging/colour_regions.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Ycbcr chroma(double cb, double cr) {
    return {128, static_cast<std::uint8_t>(cb), static_cast<std::uint8_t>(cr)};
}

/// So many samples spread over a few cells around a chroma.
void add_surface(ChromaHistogram& histogram, double cb, double cr, float samples) {
    for (const double off_cb : {-4.0, 0.0, 4.0})
        for (const double off_cr : {-4.0, 0.0, 4.0}) histogram.add(chroma(cb + off_cb, cr + off_cr), samples);
}

/// What blur and noise leave between two chromas.
void add_between(ChromaHistogram& histogram, Eigen::Vector2d from, Eigen::Vector2d to, float samples) {
    for (double share = 0.0; share <= 1.0; share += 0.02) {
        const Eigen::Vector2d at = from + share * (to - from);
        histogram.add(chroma(at.x(), at.y()), samples);
    }
}

struct Hall {
    Hall() {
        add_surface(histogram, carpet.x(), carpet.y(), 1000.0F);
        add_surface(histogram, shaded.x(), shaded.y(), 300.0F);
        add_surface(histogram, wall.x(), wall.y(), 300.0F);
        add_between(histogram, carpet, shaded, 20.0F);
        add_between(histogram, shaded, wall, 20.0F);
    }
    Eigen::Vector2d carpet{108, 88}, shaded{114, 102}, wall{124, 124};  // Cb, Cr
    ChromaHistogram histogram;
};

TEST(ChromaHistogram, WhatBlurJoinsIsOneRegion) {
    const Hall hall;
    const ChromaRegion region = hall.histogram.region_around_mode();
    EXPECT_TRUE(region.holds(chroma(hall.carpet.x(), hall.carpet.y())));
    EXPECT_TRUE(region.holds(chroma(hall.wall.x(), hall.wall.y())));
}

TEST(ChromaHistogram, ARivalNearerToGreyIsCutOffAndAShadeIsNot) {
    const Hall hall;
    const ChromaRegion cut = hall.histogram.without_rivals(hall.histogram.region_around_mode());
    EXPECT_TRUE(cut.holds(chroma(hall.carpet.x(), hall.carpet.y())));
    EXPECT_TRUE(cut.holds(chroma(hall.shaded.x(), hall.shaded.y())));
    EXPECT_FALSE(cut.holds(chroma(hall.wall.x(), hall.wall.y())));
    EXPECT_EQ(cut.cb, hall.histogram.region_around_mode().cb);
}

TEST(ChromaHistogram, ASurfaceInSunAndShadowIsOneAndAnotherHueIsAnother) {
    ChromaHistogram histogram;
    add_surface(histogram, 48, 138, 100.0F);
    add_surface(histogram, 92, 132, 30.0F);   // in the shadow
    add_surface(histogram, 128, 180, 30.0F);  // red
    add_surface(histogram, 20, 142, 4.0F);    // too few to tell
    const ChromaRegion mode = histogram.region_around_mode(), shades = histogram.shades_of_mode();
    EXPECT_FALSE(mode.holds(chroma(92, 132)));
    EXPECT_TRUE(shades.holds(chroma(48, 138)));
    EXPECT_TRUE(shades.holds(chroma(92, 132)));
    EXPECT_FALSE(shades.holds(chroma(128, 180)));
    EXPECT_FALSE(shades.holds(chroma(20, 142)));
    EXPECT_EQ(shades.cb, mode.cb);
}

TEST(ChromaHistogram, GreyHasNoHueThatAnotherColourCouldShare) {
    ChromaHistogram histogram;
    add_surface(histogram, 124, 132, 100.0F);  // white in warm light
    add_surface(histogram, 108, 190, 30.0F);   // red
    EXPECT_FALSE(histogram.shades_of_mode().holds(chroma(108, 190)));
}

TEST(ChromaHistogram, OneSurfaceAloneLosesNothing) {
    ChromaHistogram histogram;
    add_surface(histogram, 108, 88, 1000.0F);
    const ChromaRegion region = histogram.region_around_mode();
    EXPECT_EQ(cv::countNonZero(histogram.without_rivals(region).cells != region.cells), 0);
}

}  // namespace
}  // namespace goalmouth
