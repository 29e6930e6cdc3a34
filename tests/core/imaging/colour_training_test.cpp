#include "core/imaging/colour_training.h"

#include "core/imaging/colour_labels.h"
#include "core/imaging/conversion.h"

#include <random>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

/// Samples around a colour.
template <class F>
void around(Ycbcr centre, double sigma, int count, unsigned seed, F f) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, sigma);
    const auto level = [&](std::uint8_t v) { return cv::saturate_cast<std::uint8_t>(v + noise(random)); };
    for (int i = 0; i < count; ++i) f(Ycbcr{level(centre.y), level(centre.cb), level(centre.cr)});
}

TEST(ColourTrainer, TellsSeparableColoursApart) {
    const Ycbcr field{90, 110, 95};
    const Ycbcr goal{170, 50, 155};
    const Ycbcr wall{170, 126, 130};
    ColourTrainer trainer;
    around(field, 8, 3000, 1, [&](Ycbcr p) { trainer.add(p, Colour::field); });
    around(goal, 8, 300, 2, [&](Ycbcr p) { trainer.add(p, Colour::goal); });
    around(wall, 8, 9000, 3, [&](Ycbcr p) { trainer.add(p, Colour::unclassified); });
    for (const int bits : {5, 6, 7, 8}) {
        const ColourTable table = trainer.table(bits, "t");
        const auto right = [&](Ycbcr centre, unsigned seed, Colour colour) {
            int count = 0;
            around(centre, 8, 1000, seed, [&](Ycbcr p) { count += table.at(p) == colour; });
            return count;
        };
        EXPECT_GE(right(field, 11, Colour::field), 980) << bits;
        EXPECT_GE(right(goal, 12, Colour::goal), 980) << bits;
        EXPECT_GE(right(wall, 13, Colour::unclassified), 995) << bits;
    }
}

TEST(ColourTrainer, ColoursFarFromEverySampleStayUnclassified) {
    ColourTrainer trainer;
    around({170, 50, 155}, 5, 500, 1, [&](Ycbcr p) { trainer.add(p, Colour::goal); });
    const ColourTable table = trainer.table(6, "t");
    EXPECT_EQ(table.at({170, 50, 155}), Colour::goal);
    EXPECT_EQ(table.at({60, 200, 128}), Colour::unclassified);
    EXPECT_LT(class_counts(table)[static_cast<std::size_t>(Colour::goal)], 4000U);
}

TEST(ColourTrainer, OverlapGoesToTheHeavierPrior) {
    for (const bool goal_first : {true, false}) {
        ColourTrainingParameters parameters;
        parameters.prior_goal = goal_first ? 0.6 : 0.2;
        parameters.prior_ball = goal_first ? 0.2 : 0.6;
        ColourTrainer trainer(parameters);
        around({170, 50, 155}, 6, 800, 1, [&](Ycbcr p) { trainer.add(p, Colour::goal); });
        around({170, 50, 155}, 6, 800, 2, [&](Ycbcr p) { trainer.add(p, Colour::ball); });
        EXPECT_EQ(trainer.table(6, "t").at({170, 50, 155}), goal_first ? Colour::goal : Colour::ball);
    }
}

TEST(ColourTrainer, TheNumberOfSamplesOfAClassIsNoVote) {
    ColourTrainer trainer;
    around({170, 50, 150}, 6, 200, 1, [&](Ycbcr p) { trainer.add(p, Colour::goal); });
    around({170, 90, 150}, 6, 200000, 2, [&](Ycbcr p) { trainer.add(p, Colour::unclassified); });
    EXPECT_EQ(trainer.table(6, "t").at({170, 54, 150}), Colour::goal);
}

TEST(ColourTrainer, WithoutAnyClassThereIsNoTable) {
    ColourTrainer trainer;
    EXPECT_THROW(trainer.table(6, "t"), std::invalid_argument);
    trainer.add({1, 2, 3}, Colour::unclassified);
    EXPECT_THROW(trainer.table(6, "t"), std::invalid_argument);
}

TEST(ColourTrainer, SamplesAtTheRimOfTheColourSpaceAreKept) {
    ColourTrainer trainer;
    trainer.add({255, 0, 255}, Colour::goal, 100.0);
    trainer.add({0, 255, 0}, Colour::ball, 100.0);
    const ColourTable table = trainer.table(6, "t");
    EXPECT_EQ(table.at({255, 0, 255}), Colour::goal);
    EXPECT_EQ(table.at({0, 255, 0}), Colour::ball);
}

TEST(ColourTrainer, LabelsMustFitTheImage) {
    ColourTrainer trainer;
    const YuyvImage image(4, 4);
    EXPECT_THROW(trainer.add(image.view(), cv::Mat(4, 5, CV_8UC1, cv::Scalar(0))), std::invalid_argument);
}

/// A wall, a carpet with a line and a ball on it, and a post with a crossbar.
LabelledScene synthetic_scene() {
    cv::Mat bgr(240, 320, CV_8UC3, cv::Scalar(150, 160, 160));
    bgr.rowRange(110, 240).setTo(cv::Scalar(60, 120, 50));
    cv::rectangle(bgr, {0, 180}, {319, 187}, cv::Scalar(225, 228, 226), cv::FILLED);
    cv::circle(bgr, {70, 145}, 12, cv::Scalar(30, 100, 230), cv::FILLED);
    cv::rectangle(bgr, {200, 20}, {219, 129}, cv::Scalar(34, 184, 226), cv::FILLED);
    cv::rectangle(bgr, {100, 20}, {219, 33}, cv::Scalar(34, 184, 226), cv::FILLED);
    cv::Mat noise(bgr.size(), CV_16SC3);
    cv::RNG random(5);
    random.fill(noise, cv::RNG::NORMAL, 0, 4);
    cv::add(bgr, noise, bgr, cv::noArray(), CV_8U);
    return {yuyv_from_bgr(bgr), {{{200, 129}, {219, 129}, {219, 20}, {200, 20}}}, {cv::Rect(0, 0, 40, 40)}};
}

TEST(ColourLabels, FindFieldLineAndBallWherePeopleMarkedPostsOnly) {
    const std::vector<LabelledScene> scenes = {synthetic_scene()};
    const cv::Mat labels = label_scene(scenes[0], find_field_colour(scenes), find_goal_colour(scenes));
    const auto label = [&](int x, int y) { return static_cast<int>(labels.at<std::uint8_t>(y, x)); };
    EXPECT_EQ(label(210, 80), static_cast<int>(Colour::goal));
    EXPECT_EQ(label(30, 215), static_cast<int>(Colour::field));
    EXPECT_EQ(label(150, 184), static_cast<int>(Colour::line));
    EXPECT_EQ(label(70, 145), static_cast<int>(Colour::ball));
    EXPECT_EQ(label(120, 80), static_cast<int>(Colour::unclassified));
    EXPECT_EQ(label(130, 26), int{ColourTrainer::no_label}) << "the crossbar is goal, but nobody marked it";
    EXPECT_EQ(label(20, 20), int{ColourTrainer::no_label}) << "ignored by the annotation";
    EXPECT_EQ(label(200, 80), int{ColourTrainer::no_label}) << "the rim of the post";
}

TEST(ColourLabels, ATableLearntFromThemFindsThePostAndNothingElse) {
    const std::vector<LabelledScene> scenes = {synthetic_scene()};
    const cv::Mat labels = label_scene(scenes[0], find_field_colour(scenes), find_goal_colour(scenes));
    ColourTrainer trainer;
    trainer.add(scenes[0].image.view(), labels);
    const GoalColourScore score = score_goal_colour(scenes[0], trainer.table(6, "t"));
    EXPECT_GT(score.inside, 1000);
    EXPECT_GE(static_cast<double>(score.inside_goal), 0.99 * static_cast<double>(score.inside));
    EXPECT_LE(static_cast<double>(score.elsewhere_goal), 0.001 * static_cast<double>(score.elsewhere));
}

TEST(ColourLabels, SayWhereThereIsNothingToLearnFrom) {
    LabelledScene grey{yuyv_from_bgr(cv::Mat(60, 80, CV_8UC3, cv::Scalar(90, 90, 90))), {}, {}};
    const std::vector<LabelledScene> scenes = {grey};
    EXPECT_THROW(find_field_colour(scenes), std::invalid_argument);
    EXPECT_THROW(find_goal_colour(scenes), std::invalid_argument);
    EXPECT_THROW(find_field_colour({}), std::invalid_argument);
}

}  // namespace
}  // namespace goalmouth
