#include "core/colour_learning/light_tracker.h"

#include "core/colour_learning/field_search.h"
#include "core/imaging/conversion.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace goalmouth {
namespace {

const Eigen::Vector3d carpet(52, 122, 62);

/// A tracker that has seen the carpet in the light of its table, until 1 s.
LightTracker ready(const LightTrackerParameters& parameters = {}) {
    LightTracker tracker(parameters);
    for (int i = 0; i < parameters.reference_looks; ++i) tracker.follow({carpet}, 100'000 * (i + 1));
    return tracker;
}

/// The lower part of the picture in one colour, below a grey wall.
YuyvImage view_of(const Eigen::Vector3d& rgb) {
    cv::Mat bgr(240, 320, CV_8UC3, cv::Scalar(150, 158, 160));
    bgr(cv::Rect(0, 100, 320, 140)).setTo(cv::Scalar(rgb.z(), rgb.y(), rgb.x()));
    return yuyv_from_bgr(bgr);
}

TEST(LightTracker, FollowsSlowChanges) {
    LightTracker tracker = ready();
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(tracker.follow({0.8 * carpet}, 1'000'000 + 100'000 * i));
    EXPECT_NEAR(tracker.gains().red, 0.8, 0.01);
    EXPECT_NEAR(tracker.gains().blue, 0.8, 0.01);
}

TEST(LightTracker, BelievesAJumpOnceItHasLasted) {
    LightTracker tracker = ready();
    for (int i = 0; i < 15; ++i) EXPECT_FALSE(tracker.follow({0.4 * carpet}, 1'100'000 + 100'000 * i));
    EXPECT_EQ(tracker.gains(), ColourGains{});
    EXPECT_TRUE(tracker.follow({0.4 * carpet}, 2'600'000));
    EXPECT_NEAR(tracker.gains().green, 0.4, 1e-9);
}

TEST(LightTracker, DoesNotBelieveLooksThatDisagree) {
    LightTracker tracker = ready();
    for (int i = 0; i < 60; ++i)
        EXPECT_FALSE(tracker.follow({(i % 2 == 0 ? 0.4 : 2.0) * carpet}, 1'100'000 + 100'000 * i));
    EXPECT_EQ(tracker.gains(), ColourGains{});
}

TEST(LightTracker, DoesNotBelieveAJumpThatWasLeftOff) {
    LightTracker tracker = ready();
    for (int i = 0; i < 10; ++i) tracker.follow({0.4 * carpet}, 1'100'000 + 100'000 * i);
    tracker.follow({carpet}, 2'100'000);
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(tracker.follow({0.4 * carpet}, 2'200'000 + 100'000 * i));
}

TEST(LightTracker, AClippedChannelGoesWithTheOthers) {
    LightTracker tracker = ready();
    for (int i = 0; i < 200; ++i) {
        const double light = std::min(3.0, 1.0 + 0.02 * i);
        tracker.follow({(light * carpet).cwiseMin(255.0)}, 1'100'000 + 100'000 * i);
    }
    EXPECT_NEAR(tracker.gains().red, 3.0, 0.1);
    EXPECT_NEAR(tracker.gains().green, 3.0, 0.2);
}

TEST(LightTracker, AChannelThatClipsHasGoneAsFarAsThat) {
    // A lamp so red that red and green come to lie at the end of the scale, blue where it was.
    LightTracker tracker = ready();
    for (int i = 0; i < 20; ++i)
        tracker.follow({Eigen::Vector3d(6.0, 3.0, 1.0).cwiseProduct(carpet).cwiseMin(255.0)},
                       1'100'000 + 100'000 * i);
    EXPECT_NEAR(tracker.gains().red, 250.0 / 52, 0.01);
    EXPECT_NEAR(tracker.gains().green, 250.0 / 122, 0.01);
    EXPECT_NEAR(tracker.gains().blue, 1.0, 1e-9);
}

TEST(LightTracker, ABlackChannelSaysNothingAboutOthers) {
    LightTracker tracker = ready();
    for (int i = 0; i < 20; ++i) tracker.follow({{255.0, 183.0, 0.0}}, 1'100'000 + 100'000 * i);
    EXPECT_NEAR(tracker.gains().red, 250.0 / 52, 0.01);
    EXPECT_NEAR(tracker.gains().green, 1.5, 0.01);
    EXPECT_NEAR(tracker.gains().blue, LightTrackerParameters{}.lowest, 1e-9);
}

TEST(LightTracker, GainsStayWithinTheirBoundsToTheLastBit) {
    for (double before = 0.5; before < 1.0; before += 0.05) {
        LightTracker tracker = ready();
        for (int i = 0; i < 50; ++i) tracker.follow({before * carpet}, 1'100'000 + 1'000'000 * i);
        for (int i = 0; i < 50; ++i)
            tracker.follow({{carpet.x(), carpet.y(), 0.0}}, 60'000'000 + 100'000 * i);
        EXPECT_GE(tracker.gains().blue, LightTrackerParameters{}.lowest) << before;
        EXPECT_LT(tracker.gains().blue, 0.06) << before;
    }
}

TEST(LightTracker, LooksOfASlowCameraAddUpToAJump) {
    LightTrackerParameters parameters;
    parameters.jump_after = 0.1;
    LightTracker tracker = ready(parameters);
    EXPECT_FALSE(tracker.suspect({0.4 * carpet}, 1'250'000));
    EXPECT_TRUE(tracker.suspect({0.4 * carpet}, 1'500'000));
}

TEST(LookAtField, IsNotPulledByWhatStandsOnTheField) {
    cv::Mat bgr(240, 320, CV_8UC3, cv::Scalar(150, 158, 160));
    bgr(cv::Rect(0, 100, 320, 140)).setTo(cv::Scalar(carpet.z(), carpet.y(), carpet.x()));
    // As large as the field but for a little, in two colours.
    bgr(cv::Rect(0, 110, 80, 130)).setTo(cv::Scalar(200, 200, 200));
    bgr(cv::Rect(80, 110, 70, 130)).setTo(cv::Scalar(40, 40, 60));
    cv::Mat noise(bgr.size(), CV_16SC3), noisy;
    cv::theRNG().state = 5;
    cv::randn(noise, cv::Scalar::all(0), cv::Scalar::all(4));
    bgr.convertTo(noisy, CV_16SC3);
    noisy += noise;
    noisy.convertTo(bgr, CV_8UC3);
    ColourTable table(6);
    for (double brightness = 0.7; brightness <= 1.3; brightness += 0.01)
        for (int r = -16; r <= 16; r += 4)
            for (int g = -16; g <= 16; g += 4)
                for (int b = -16; b <= 16; b += 4)
                    table.set(ycbcr_from_bgr(
                                  cv::Vec3b(cv::saturate_cast<std::uint8_t>(brightness * carpet.z() + b),
                                            cv::saturate_cast<std::uint8_t>(brightness * carpet.y() + g),
                                            cv::saturate_cast<std::uint8_t>(brightness * carpet.x() + r))),
                              Colour::field);
    const FieldBorder border{{{0.0, 100.0}, {319.0, 100.0}}, {}};
    const auto look = look_at_field(yuyv_from_bgr(bgr).view(), border, table, {});
    ASSERT_TRUE(look);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(look->rgb[c], carpet[c], 1.5) << c;
}

TEST(SearchField, FindsTheFieldInAnyLight) {
    for (const Eigen::Vector3d& light : {Eigen::Vector3d(0.3, 0.3, 0.3), Eigen::Vector3d(1.57, 1.0, 0.42),
                                         Eigen::Vector3d(0.64, 1.0, 2.0), Eigen::Vector3d(3.0, 3.0, 3.0)}) {
        const Eigen::Vector3d seen = carpet.cwiseProduct(light).cwiseMin(255.0);
        const auto look = search_field(view_of(seen).view(), carpet, {});
        ASSERT_TRUE(look) << light.transpose();
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(look->rgb[c], seen[c], 2.0) << light.transpose();
    }
}

TEST(SearchField, FindsNoneOnWalls) {
    for (const Eigen::Vector3d& wall :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(255, 255, 255), Eigen::Vector3d(160, 158, 150),
          Eigen::Vector3d(20, 20, 22), Eigen::Vector3d(170, 90, 30), Eigen::Vector3d(225, 190, 40),
          Eigen::Vector3d(60, 80, 160), Eigen::Vector3d(150, 40, 60)})
        EXPECT_FALSE(search_field(view_of(wall).view(), carpet, {})) << wall.transpose();
}

TEST(SearchField, NeedsMostOfTheLowerHalf) {
    cv::Mat bgr(240, 320, CV_8UC3, cv::Scalar(150, 158, 160));
    bgr(cv::Rect(0, 190, 320, 50)).setTo(cv::Scalar(31, 61, 26));
    EXPECT_FALSE(search_field(yuyv_from_bgr(bgr).view(), carpet, {}));
}

}  // namespace
}  // namespace goalmouth
