#include "core/refinement/step_profile.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(StepProfile, RisesFromZeroToOneAboutTheEdge) {
    StepProfile profile;
    profile.set_blur(1.1, 0.3);
    EXPECT_EQ(profile.at(-50.0F).step, 0.0F);
    EXPECT_EQ(profile.at(50.0F).step, 1.0F);
    EXPECT_NEAR(profile.at(0.0F).step, 0.5F, 1e-4F);
    for (float x = -6.0F; x < 6.0F; x += 0.1F) {
        EXPECT_LE(profile.at(x).step, profile.at(x + 0.1F).step + 1e-6F);
        EXPECT_NEAR(profile.at(x).step + profile.at(-x).step, 1.0F, 1e-4F);
    }
}

TEST(StepProfile, ItsSlopeAndBlurAreItsDerivatives) {
    StepProfile profile, wider;
    profile.set_blur(0.9, 0.0);
    wider.set_blur(0.91, 0.0);
    for (float x = -3.0F; x < 3.0F; x += 0.23F) {
        const float slope = (profile.at(x + 0.1F).step - profile.at(x - 0.1F).step) / 0.2F;
        EXPECT_NEAR(profile.at(x).slope, slope, 3e-3F);
        EXPECT_NEAR(profile.at(x).blur, (wider.at(x).step - profile.at(x).step) / 0.01F, 2e-2F);
    }
}

TEST(StepProfile, APairGathersOverTwoPixels) {
    StepProfile profile;
    profile.set_blur(0.3, 0.0);  // hardly any: a ramp two pixels long
    EXPECT_NEAR(profile.at(-0.5F).step, 0.25F, 0.01F);
    EXPECT_NEAR(profile.at(0.5F).step, 0.75F, 0.01F);
}

TEST(StepProfile, TheDigitalShareIsThatOfWeightsAtWholePixels) {
    constexpr double sigma = 0.85, edge = 0.3;
    StepProfile profile;
    profile.set_blur(sigma, 1.0);
    const auto pixel = [&](int i) {  // of a sharp picture, then blurred
        double sum = 0.0, weights = 0.0;
        for (int k = -4; k <= 4; ++k) {
            const double w = std::exp(-0.5 * k * k / (sigma * sigma));
            sum += w * std::min(1.0, std::max(0.0, i + k + 0.5 - edge));
            weights += w;
        }
        return sum / weights;
    };
    for (int i = -6; i < 6; i += 2)
        EXPECT_NEAR(profile.at(static_cast<float>(i + 0.5 - edge)).step, 0.5 * (pixel(i) + pixel(i + 1)),
                    2e-3);
}

}  // namespace
}  // namespace goalmouth
