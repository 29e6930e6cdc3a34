#include "core/colour_teaching/teaching_session.h"

#include "tests/support/stripes.h"

#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

using test::stripes;
using testing::HasSubstr;

/// Two pictures of stripes.
class TeachingSessionTest : public testing::Test {
  protected:
    static ColourMark box(Colour colour, int x, std::size_t picture = 0) {
        return {picture, colour, MarkedBox{{x, 4, 20, 50}}};
    }
    Colour seen(int x) const { return session.table()->at(session.picture(0).at(x, 30)); }

    TeachingSession session{{stripes(), stripes()}};
};

TEST_F(TeachingSessionTest, TheTableFollowsEachMark) {
    EXPECT_FALSE(session.table());
    EXPECT_THAT(session.problem(), HasSubstr("nothing is marked"));
    session.add(box(Colour::unclassified, 64));
    EXPECT_FALSE(session.table());
    EXPECT_THAT(session.problem(), HasSubstr("all marks are unclassified"));
    session.add(box(Colour::field, 4));
    EXPECT_EQ(session.problem(), "");
    EXPECT_EQ(seen(10), Colour::field);
    EXPECT_EQ(seen(45), Colour::unclassified);
    session.add(box(Colour::goal, 34));
    EXPECT_EQ(seen(45), Colour::goal);
    EXPECT_EQ(seen(75), Colour::unclassified);
    EXPECT_EQ(session.samples()[static_cast<std::size_t>(Colour::goal)], 20U * 50U);
}

TEST_F(TeachingSessionTest, StepsAreTakenBackAndMadeAgain) {
    session.add(box(Colour::field, 4));
    session.add(box(Colour::goal, 34, 1));
    EXPECT_EQ(session.undo(), 1U);  // the picture it was in
    EXPECT_EQ(session.marks().size(), 1U);
    EXPECT_EQ(seen(45), Colour::unclassified);
    EXPECT_EQ(session.redo(), 1U);
    EXPECT_EQ(seen(45), Colour::goal);
    EXPECT_FALSE(session.redo());
    EXPECT_EQ(session.undo(), 1U);
    EXPECT_EQ(session.undo(), 0U);
    EXPECT_FALSE(session.undo());
    EXPECT_TRUE(session.marks().empty());
    EXPECT_FALSE(session.table());
    // A new step after an undo: what was taken back is gone.
    session.add(box(Colour::ball, 34));
    EXPECT_FALSE(session.redo());
    EXPECT_EQ(session.marks().size(), 1U);
}

TEST_F(TeachingSessionTest, AClassIsUnmarkedInOneStep) {
    session.add(box(Colour::goal, 34));
    session.add(box(Colour::field, 4));
    session.add(box(Colour::goal, 34, 1));
    EXPECT_TRUE(session.remove_class(Colour::goal));
    ASSERT_EQ(session.marks().size(), 1U);
    EXPECT_EQ(session.marks()[0]->mark.colour, Colour::field);
    EXPECT_FALSE(session.remove_class(Colour::goal));
    EXPECT_EQ(session.undo(), 0U);  // the first that comes back
    EXPECT_EQ(session.marks().size(), 3U);
}

TEST_F(TeachingSessionTest, TheMarkUnderAPixelIsTheNewest) {
    session.add(box(Colour::field, 4));
    session.add(box(Colour::line, 10));
    session.add(box(Colour::goal, 10, 1));
    EXPECT_EQ(session.mark_at(0, {5, 10}), 0U);
    EXPECT_EQ(session.mark_at(0, {12, 10}), 1U);
    EXPECT_EQ(session.mark_at(1, {12, 10}), 2U);
    EXPECT_FALSE(session.mark_at(1, {5, 10}));
    EXPECT_TRUE(session.remove(1));
    EXPECT_EQ(session.mark_at(0, {12, 10}), 0U);
    EXPECT_FALSE(session.remove(7));
}

TEST_F(TeachingSessionTest, GoesOnFromMarksThatNoUndoTakesBack) {
    TeachingSession on({stripes(), stripes()}, 6, {box(Colour::field, 4), box(Colour::goal, 34, 1)});
    EXPECT_EQ(on.marks().size(), 2U);
    EXPECT_EQ(on.problem(), "");
    EXPECT_FALSE(on.changed());
    EXPECT_FALSE(on.undo());
    on.add(box(Colour::line, 64));
    EXPECT_EQ(on.undo(), 0U);
    EXPECT_EQ(on.marks().size(), 2U);
    EXPECT_FALSE(on.changed());
}

TEST_F(TeachingSessionTest, KnowsWhetherItsMarksAreKept) {
    EXPECT_FALSE(session.changed());
    session.add(box(Colour::field, 4));
    EXPECT_TRUE(session.changed());
    session.keep();
    EXPECT_FALSE(session.changed());
    session.undo();
    EXPECT_TRUE(session.changed());
    session.redo();
    EXPECT_FALSE(session.changed());
}

TEST_F(TeachingSessionTest, ClassesWithTheSameColoursAreNamed) {
    session.add(box(Colour::goal, 34));
    session.add(box(Colour::ball, 34));
    EXPECT_THAT(session.problem(), HasSubstr("ball and goal were given the same colours: 100 %"));
    EXPECT_TRUE(session.table());  // to look at
    session.undo();
    EXPECT_EQ(session.problem(), "");
}

TEST_F(TeachingSessionTest, MarksThatDoNotFitChangeNothing) {
    session.add(box(Colour::field, 4));
    EXPECT_THROW(session.add(box(Colour::field, 80)), std::invalid_argument);
    EXPECT_THROW(session.add(box(Colour::field, 4, 2)), std::invalid_argument);
    EXPECT_THROW(TeachingSession({stripes()}, 6, {box(Colour::field, 80)}), std::invalid_argument);
    EXPECT_EQ(session.marks().size(), 1U);
    EXPECT_EQ(session.undo(), 0U);
}

TEST_F(TeachingSessionTest, AFinerTableIsMade) {
    TeachingSession fine({stripes()}, 7);
    fine.add(box(Colour::field, 4));
    EXPECT_EQ(fine.table()->bits(), 7);
}

TEST(BlackPicture, IsOneWithNothingBrighterThanSixteen) {
    EXPECT_TRUE(is_black(yuyv_from_bgr(cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(16))).view()));
    cv::Mat spot(8, 8, CV_8UC3, cv::Scalar::all(0));
    spot.at<cv::Vec3b>(7, 7) = {40, 40, 40};
    EXPECT_FALSE(is_black(yuyv_from_bgr(spot).view()));
}

}  // namespace
}  // namespace goalmouth
