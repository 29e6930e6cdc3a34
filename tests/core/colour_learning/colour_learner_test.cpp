#include "core/colour_learning/colour_learner.h"

#include "tests/core/colour_learning/drawn_pitch.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::draw_pitch;
using test::DrawnPitch;
using testing::HasSubstr;

std::vector<YuyvImage> pictures_of(const DrawnPitch& pitch, unsigned count, unsigned first = 0) {
    std::vector<YuyvImage> pictures;
    for (unsigned n = 0; n < count; ++n) pictures.push_back(draw_pitch(pitch, first + n).image);
    return pictures;
}

struct Agreement {
    double recall = 0.0;
    double precision = 0.0;
};

/// How a table's answers agree with the truth of pictures it was not learnt from, away from borders between
/// classes. What has the goal's colour and is no goal nobody can tell by colour: it counts for nobody.
Agreement agreement(const ColourTable& table, const DrawnPitch& pitch, Colour colour) {
    double right = 0.0, wanted = 0.0, called = 0.0;
    for (unsigned n = 100; n < 103; ++n) {
        const test::DrawnPicture picture = draw_pitch(pitch, n);
        cv::Mat lowest, highest;
        cv::erode(picture.truth, lowest, cv::Mat::ones(5, 5, CV_8UC1));
        cv::dilate(picture.truth, highest, cv::Mat::ones(5, 5, CV_8UC1));
        for (int y = 0; y < picture.truth.rows; ++y) {
            for (int x = 0; x < picture.truth.cols; ++x) {
                const auto truth = static_cast<Colour>(picture.truth.at<std::uint8_t>(y, x));
                if (lowest.at<std::uint8_t>(y, x) != highest.at<std::uint8_t>(y, x)) continue;
                const bool is = table.at(picture.image.view().at(x, y)) == colour;
                if (truth == Colour::unclassified && colour == Colour::goal) continue;
                right += is && truth == colour;
                wanted += truth == colour;
                called += is;
            }
        }
    }
    return {right / wanted, called > 0.0 ? right / called : 0.0};
}

struct Case {
    std::string name;
    test::Light light;
};

class Lights : public testing::TestWithParam<Case> {};

TEST_P(Lights, EveryColourIsLearntFromAFewPictures) {
    DrawnPitch pitch;
    pitch.light = GetParam().light;
    const LearntColours learnt = learn_without_labels(pictures_of(pitch, 6), GoalPaint::yellow, 6, "t");
    for (const Colour colour : {Colour::field, Colour::line, Colour::ball, Colour::goal}) {
        const Agreement a = agreement(learnt.table, pitch, colour);
        const auto name = colour_names[static_cast<std::size_t>(colour)];
        EXPECT_GE(a.recall, 0.95) << name;
        // Brown things on the wall are like the ball in poor light, and are in the ball's precision here.
        EXPECT_GE(a.precision, colour == Colour::ball ? 0.6 : 0.95) << name;
        // Things on the wall in the goal's colour make pictures doubt it.
        EXPECT_GE(learnt.classes[static_cast<std::size_t>(colour)].confidence(), 0.7) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(ColourLearner, Lights,
                         testing::Values(Case{"day", {}}, Case{"warm", {1.1, 0.95, 0.6}},
                                         Case{"cold", {0.85, 1.0, 1.2}}, Case{"dark", {0.4, 0.4, 0.4}}),
                         [](const auto& one) { return one.param.name; });

TEST(ColourLearner, AWallInTheCarpetsReflectionIsNotField) {
    DrawnPitch pitch;
    pitch.wall = {100, 130, 105};
    pitch.light = {0.6, 0.6, 0.6};
    const LearntColours learnt = learn_without_labels(pictures_of(pitch, 6), GoalPaint::yellow, 6, "t");
    EXPECT_GE(agreement(learnt.table, pitch, Colour::field).precision, 0.95);
    EXPECT_GE(agreement(learnt.table, pitch, Colour::field).recall, 0.95);
    EXPECT_GE(agreement(learnt.table, pitch, Colour::goal).recall, 0.95);
}

TEST(ColourLearner, PostsInTheSunAndInTheShadowAreOfOneColour) {
    DrawnPitch sun, shadow;
    shadow.light = {0.4, 0.4, 0.4};
    std::vector<YuyvImage> pictures = pictures_of(sun, 4);
    for (YuyvImage& picture : pictures_of(shadow, 4, 4)) pictures.push_back(std::move(picture));
    const LearntColours learnt = learn_without_labels(pictures, GoalPaint::yellow, 6, "t");
    EXPECT_GE(agreement(learnt.table, sun, Colour::goal).recall, 0.95);
    EXPECT_GE(agreement(learnt.table, shadow, Colour::goal).recall, 0.95);
}

TEST(ColourLearner, WhiteGoalsAreTheClassGoal) {
    DrawnPitch pitch;
    pitch.goal = {226, 228, 228};
    const LearntColours learnt = learn_without_labels(pictures_of(pitch, 6), GoalPaint::white, 6, "t");
    EXPECT_GE(agreement(learnt.table, pitch, Colour::goal).recall, 0.9);
    EXPECT_GE(agreement(learnt.table, pitch, Colour::field).recall, 0.95);
    EXPECT_EQ(learnt.table.at({230, 128, 128}), Colour::goal);
}

TEST(ColourLearner, TheSamePicturesGiveTheSameBytes) {
    const std::vector<YuyvImage> pictures = pictures_of({}, 3);
    const LearntColours one = learn_without_labels(pictures, GoalPaint::yellow, 7, "t");
    const LearntColours two = learn_without_labels(pictures, GoalPaint::yellow, 7, "t");
    EXPECT_TRUE(one.table == two.table);
    EXPECT_EQ(one.table.bits(), 7);
    EXPECT_EQ(one.classes[4].confidence(), two.classes[4].confidence());
}

TEST(ColourLearner, NoBallIsNoBallColour) {
    DrawnPitch pitch;
    pitch.ball = false;
    const LearntColours learnt = learn_without_labels(pictures_of(pitch, 4), GoalPaint::yellow, 6, "t");
    const auto ball = static_cast<std::size_t>(Colour::ball);
    EXPECT_EQ(learnt.classes[ball].samples, 0.0);
    EXPECT_EQ(class_counts(learnt.table)[ball], 0U);
    EXPECT_EQ(learnt.classes[ball].confidence(), 0.0);
}

TEST(ColourLearner, OnePictureTeachesButProvesNothing) {
    const LearntColours learnt = learn_without_labels(pictures_of({}, 1), GoalPaint::yellow, 6, "t");
    EXPECT_GE(agreement(learnt.table, {}, Colour::goal).recall, 0.9);
    EXPECT_FALSE(learnt.classes[static_cast<std::size_t>(Colour::goal)].recall);
    EXPECT_EQ(learnt.classes[static_cast<std::size_t>(Colour::goal)].confidence(), 0.0);
}

std::string refusal(const std::vector<YuyvImage>& pictures, GoalPaint paint = GoalPaint::yellow) {
    try {
        learn_without_labels(pictures, paint, 6, "t");
    } catch (const NothingToLearn& error) {
        return error.what();
    }
    return "learnt";
}

TEST(ColourLearner, SaysWhatIsMissing) {
    const auto plain = [](const cv::Scalar& bgr) {
        return std::vector<YuyvImage>(3, yuyv_from_bgr(cv::Mat(120, 160, CV_8UC3, bgr)));
    };
    EXPECT_THAT(refusal({}), HasSubstr("no picture"));
    EXPECT_THAT(refusal(plain({0, 0, 0})), HasSubstr("none of the 3 pictures shows a field"));
    EXPECT_THAT(refusal(plain({40, 190, 225})), HasSubstr("shows a field"));
    EXPECT_THAT(refusal(plain({60, 120, 45})), HasSubstr("shows a goalpost"));
    EXPECT_THAT(refusal(plain({60, 120, 45}), GoalPaint::white), HasSubstr("shows a line"));
    DrawnPitch bare;
    bare.posts = false;
    EXPECT_THAT(refusal(pictures_of(bare, 3)), HasSubstr("shows a goalpost"));
    DrawnPitch hall;
    hall.field = hall.lines = hall.ball = false;
    EXPECT_THAT(refusal(pictures_of(hall, 3)), HasSubstr("shows a field"));
    EXPECT_THAT(refusal({yuyv_from_bgr(cv::Mat(1, 1, CV_8UC3, cv::Scalar(9, 9, 9)))}),
                HasSubstr("shows a field"));
}

TEST(ColourLearner, PicturesOfAnySize) {
    std::vector<YuyvImage> pictures;
    for (unsigned n = 0; n < 4; ++n) {
        const cv::Mat small = bgr_from_yuyv(draw_pitch({}, n).image.view());
        cv::Mat large;
        cv::resize(small, large, {1601, 1199});
        pictures.push_back(yuyv_from_bgr(n % 2 == 0 ? large : small));
    }
    const LearntColours learnt = learn_without_labels(pictures, GoalPaint::yellow, 6, "t");
    EXPECT_GE(agreement(learnt.table, {}, Colour::goal).recall, 0.95);
}

}  // namespace
}  // namespace goalmouth
