#include "core/process/configuration.h"
#include "tests/support/refusal.h"
#include "tools/evaluate/images_poses.h"

#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;

std::string refusal(const std::string& pattern) {
    return message_of([&] { const PlacePattern refused(pattern); });
}

TEST(PlacePattern, ReadsNumbersInTheirUnits) {
    const PlacePattern pattern("{}_{x_cm}_{y_mm}_{heading_deg}_{head_pitch_rad}_{head_yaw_rad}_{}");
    const auto place = pattern.place("nao/000023_-12.5_201_-90_-0.543078_+0.25_4VGA.png");
    ASSERT_TRUE(place);
    EXPECT_DOUBLE_EQ(place->feet.x, -0.125);
    EXPECT_DOUBLE_EQ(place->feet.y, 0.201);
    EXPECT_DOUBLE_EQ(place->feet.theta, -90.0 * degree);
    EXPECT_DOUBLE_EQ(place->head_pitch, -0.543078);
    EXPECT_DOUBLE_EQ(place->head_yaw, 0.25);
    EXPECT_NEAR(place->looks(), 0.25 - 0.5 * std::numbers::pi, 1e-12);
}

TEST(PlacePattern, HeadLooksAheadWhereTheNameDoesNotTell) {
    const auto place = PlacePattern("at {x_m} {y_m} {heading_rad}").place("at 1 2 3.png");
    ASSERT_TRUE(place);
    EXPECT_DOUBLE_EQ(place->feet.theta, 3.0);
    EXPECT_DOUBLE_EQ(place->head_yaw, 0.0);
}

TEST(PlacePattern, TheWholeNameMustFit) {
    const PlacePattern pattern("{}_{x_cm}_{y_cm}_{heading_deg}_{}");
    EXPECT_TRUE(pattern.place("a_1_2_3_b.png"));
    EXPECT_TRUE(pattern.place("folder_of_many/a_1_2_3_b.png"));
    EXPECT_FALSE(pattern.place("a_1_2_3.png"));
    EXPECT_FALSE(pattern.place("a_1_2_left_b.png"));
    EXPECT_FALSE(pattern.place("a_1_2_nan_b.png"));
    // One piece more than the pattern has: nothing is to slip into another's place.
    EXPECT_FALSE(pattern.place("a_1_2_3_4_b.png"));
    EXPECT_FALSE(PlacePattern("{x_m},{y_m},{heading_deg}").place("1,2,3 b.png"));
    EXPECT_TRUE(pattern.place(pattern.example() + ".png")) << pattern.example();
}

TEST(PlacePattern, MistakesSayWhatIsValid) {
    EXPECT_THAT(
        refusal("{x_cm}_{y_cm}_{headin_deg}"),
        AllOf(HasSubstr("{headin_deg}"), HasSubstr("did you mean 'heading_deg'"), HasSubstr("head_yaw_rad")));
    EXPECT_THAT(refusal("{x_deg}_{y_cm}_{heading_deg}"), AllOf(HasSubstr("{x_deg}"), HasSubstr("x_cm")));
    EXPECT_THAT(refusal("{x}_{y_cm}_{heading_deg}"), HasSubstr("x_m"));
    EXPECT_THAT(refusal("{x_cm}_{heading_deg}"), AllOf(HasSubstr("y is missing"), HasSubstr("{y_cm}")));
    EXPECT_THAT(refusal("{x_cm}_{y_cm}"), HasSubstr("{heading_deg}"));
    EXPECT_THAT(refusal("{x_cm}_{x_m}_{y_cm}_{heading_deg}"), HasSubstr("{x_m} is there twice"));
    EXPECT_THAT(refusal("{x_cm}{y_cm}_{heading_deg}"), HasSubstr("nothing stands before {y_cm}"));
    EXPECT_THAT(refusal("{x_cm_{y_cm}_{heading_deg}"), HasSubstr("brace"));
    EXPECT_THAT(refusal("x_cm}_{y_cm}_{heading_deg}"), HasSubstr("brace"));
    EXPECT_THAT(refusal("{x_cm}_{y_cm}_{heading_deg"), HasSubstr("brace"));
    EXPECT_THAT(refusal(""), HasSubstr("x is missing"));
}

}  // namespace
}  // namespace goalmouth
