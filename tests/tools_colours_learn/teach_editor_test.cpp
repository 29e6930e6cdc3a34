#include "tools/colours/teach_editor.h"

#include "tests/support/stripes.h"
#include "tools/colours/click_tracker.h"
#include "tools/colours/teach_layout.h"
#include "tools/colours/teach_view.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

using test::stripes;
using testing::HasSubstr;

class TeachEditorTest : public testing::Test {
  protected:
    void keys(const std::string& codes) {
        for (const char code : codes) editor.key(code);
    }
    void clicks(const std::vector<cv::Point>& places) {
        for (const cv::Point at : places) editor.click(at);
    }
    const ColourMark& last() const { return session.marks().back()->mark; }

    int saved = 0;
    std::string save_problem;
    TeachingSession session{{stripes(), stripes(), stripes()}};
    TeachEditor editor{session, {"1.png", "2.png", "3.png"}, [this]() -> std::string {
                           if (!save_problem.empty()) throw std::runtime_error(save_problem);
                           ++saved;
                           session.keep();
                           return "saved";
                       }};
};

TEST_F(TeachEditorTest, APolygonIsClosedByEnterOrRightClick) {
    keys("4p");
    clicks({{32, 2}, {56, 2}, {56, 50}});
    EXPECT_TRUE(session.marks().empty());
    editor.key(TeachEditor::enter);
    ASSERT_EQ(session.marks().size(), 1U);
    EXPECT_EQ(last(), (ColourMark{0, Colour::goal, MarkedPolygon{{{32, 2}, {56, 2}, {56, 50}}}}));
    keys("1");
    clicks({{2, 2}, {20, 2}, {20, 50}});
    editor.right_click({5, 5});
    ASSERT_EQ(session.marks().size(), 2U);
    EXPECT_EQ(last().colour, Colour::field);
    EXPECT_TRUE(editor.corners().empty());
}

TEST_F(TeachEditorTest, CornersCanBeTakenBack) {
    keys("4p");
    clicks({{32, 2}, {56, 2}, {1, 1}});
    editor.key(TeachEditor::backspace);
    clicks({{56, 50}});
    editor.key(TeachEditor::enter);
    EXPECT_EQ(last().shape, MarkShape(MarkedPolygon{{{32, 2}, {56, 2}, {56, 50}}}));
    clicks({{32, 2}, {56, 2}});
    editor.key(TeachEditor::enter);  // too few: goes on
    EXPECT_TRUE(editor.alarmed());
    EXPECT_EQ(editor.corners().size(), 2U);
    editor.key(TeachEditor::escape);
    EXPECT_TRUE(editor.corners().empty());
    editor.key(TeachEditor::backspace);
    EXPECT_EQ(session.marks().size(), 1U);
}

TEST_F(TeachEditorTest, FillTakesItsToleranceFromTheKeys) {
    keys("4f+++-");
    clicks({{45, 20}});
    EXPECT_EQ(last(), (ColourMark{0, Colour::goal, MarkedFill{{45, 20}, 12}}));
    for (int i = 0; i < 200; ++i) keys("-");
    EXPECT_EQ(editor.tolerance(), 0);
    for (int i = 0; i < 200; ++i) keys("+");
    EXPECT_EQ(editor.tolerance(), largest_tolerance);
}

TEST_F(TeachEditorTest, ABoxIsDraggedOrClicked) {
    keys("1b");
    editor.drag({20, 40}, {4, 5});
    EXPECT_EQ(last(), (ColourMark{0, Colour::field, MarkedBox{{4, 5, 17, 36}}}));
    clicks({{25, 3}, {2, 9}});
    EXPECT_EQ(last().shape, MarkShape(MarkedBox{{2, 3, 24, 7}}));
    keys("p");
    editor.drag({20, 40}, {4, 5});  // not with the other tools
    EXPECT_EQ(session.marks().size(), 2U);
}

TEST_F(TeachEditorTest, MarksGoWhereThePictureIs) {
    keys("1f..");
    EXPECT_EQ(editor.picture_name(), "3.png");
    clicks({{5, 5}});
    EXPECT_EQ(last().picture, 2U);
    keys(".");
    EXPECT_EQ(editor.picture(), 0U);
    keys(",,");
    EXPECT_EQ(editor.picture(), 1U);
    keys("u");  // shows where something changed
    EXPECT_EQ(editor.picture(), 2U);
    EXPECT_TRUE(session.marks().empty());
    keys(".r");
    EXPECT_EQ(editor.picture(), 2U);
    EXPECT_EQ(session.marks().size(), 1U);
}

TEST_F(TeachEditorTest, MarksAreTakenAwayOneByOneOrByClass) {
    keys("1f");
    clicks({{5, 5}});
    keys("4");
    clicks({{45, 5}});
    keys(".");
    clicks({{45, 5}});
    editor.right_click({5, 5});  // nothing there in this picture
    EXPECT_EQ(session.marks().size(), 3U);
    keys("c");
    ASSERT_EQ(session.marks().size(), 1U);
    EXPECT_EQ(last().colour, Colour::field);
    keys(",");
    editor.right_click({5, 5});
    EXPECT_TRUE(session.marks().empty());
    keys("uu");
    EXPECT_EQ(session.marks().size(), 3U);
}

TEST_F(TeachEditorTest, QuittingAsksWhereSomethingIsNotSaved) {
    keys("1f");
    clicks({{5, 5}});
    keys("q");
    EXPECT_FALSE(editor.done());
    EXPECT_THAT(editor.message(), HasSubstr("not saved"));
    EXPECT_THAT(editor.title(), HasSubstr("1 mark, not saved: quit?"));
    keys("1");  // the question is forgotten by another key
    EXPECT_THAT(editor.title(), testing::EndsWith("1 mark, not saved"));
    keys("q");
    EXPECT_FALSE(editor.done());
    keys("s");
    EXPECT_EQ(saved, 1);
    EXPECT_THAT(editor.title(), testing::Not(HasSubstr("not saved")));
    keys("q");
    EXPECT_TRUE(editor.done());
}

TEST_F(TeachEditorTest, QuittingTwiceGivesUpWhatIsNotSaved) {
    keys("1f");
    clicks({{5, 5}});
    keys("qq");
    EXPECT_TRUE(editor.done());
    EXPECT_EQ(saved, 0);
}

TEST_F(TeachEditorTest, WhatGoesWrongIsSaid) {
    save_problem = "the disc is full";
    keys("1fs");
    EXPECT_EQ(editor.message(), "the disc is full");
    EXPECT_TRUE(editor.alarmed());
    clicks({{5, 5}});
    EXPECT_FALSE(editor.alarmed());
    keys("4");
    clicks({{5, 5}});
    EXPECT_THAT(editor.message(), HasSubstr("were given the same colours"));
    EXPECT_TRUE(editor.alarmed());
}

TEST_F(TeachEditorTest, ZoomKeepsWhatIsUnderThePointer) {
    editor.point_at(cv::Point(60, 40));
    keys("zz");
    EXPECT_EQ(editor.shown().size(), cv::Size(22, 15));
    EXPECT_TRUE(editor.shown().contains({60, 40}));
    EXPECT_NEAR((60.5 - editor.shown().x) / 22.0, 60.5 / 90.0, 0.05);
    keys("zzzz");
    EXPECT_EQ(editor.zoom(), 16);
    EXPECT_TRUE(editor.shown().contains({60, 40}));
    keys("xxxxxx");
    EXPECT_EQ(editor.shown(), cv::Rect(0, 0, 90, 60));
}

TEST_F(TeachEditorTest, EveryPixelOfThePanesIsOneOfThePicture) {
    for (const std::string view : {"", "v", "v", "zzv"}) {
        keys(view);
        const TeachLayout layout = layout_of(editor, first_canvas({90, 60}));
        for (const cv::Rect& pane : {layout.picture, layout.segmentation}) {
            if (pane.empty()) continue;
            for (const cv::Point pixel : {editor.shown().tl(), editor.shown().br() - cv::Point(1, 1)})
                EXPECT_EQ(layout.pixel_at(layout.place_of(pane, pixel)), pixel);
            EXPECT_FALSE(layout.pixel_at({pane.x + 5, pane.y - 1}));
        }
        EXPECT_EQ(layout.class_at((layout.classes[4].tl() + layout.classes[4].br()) / 2), Colour::goal);
    }
}

/// The view draws on every canvas, and the segmentation changes with the marks.
TEST_F(TeachEditorTest, TheViewShowsTheSegmentationAtOnce) {
    TeachView view;
    const cv::Size canvas = first_canvas({90, 60});
    const TeachLayout layout = layout_of(editor, canvas);
    const auto at_post = [&] {
        return view.draw(editor, canvas).at<cv::Vec3b>(layout.place_of(layout.segmentation, {45, 10}));
    };
    const cv::Vec3b nothing = at_post();
    keys("1f");
    clicks({{5, 5}});
    EXPECT_EQ(at_post(), nothing);
    keys("4");
    clicks({{45, 5}});
    const cv::Vec3b goal = at_post();
    EXPECT_EQ(goal, cv::Vec3b(0, 230, 255));
    keys("u");
    EXPECT_EQ(at_post(), nothing);
    editor.point_at(cv::Point(45, 5));
    for (const std::string step : {"h", "h", "v", "v", "v", "zz", ".", "p"}) {
        keys(step);
        for (const cv::Size size : {least_canvas(), canvas, cv::Size(1920, 1080)})
            EXPECT_EQ(view.draw(editor, size).size(), size);
    }
}

TEST(ClickTracker, TellsClicksFromDrags) {
    ClickTracker tracker;
    EXPECT_TRUE(std::holds_alternative<std::monostate>(tracker.release({5, 5})));  // pressed elsewhere
    tracker.press({5, 5});
    tracker.move();
    const auto click = tracker.release({7, 6});
    ASSERT_TRUE(std::holds_alternative<Click>(click));
    EXPECT_EQ(std::get<Click>(click).at, cv::Point(5, 5));
    tracker.press({5, 5});
    const auto drag = tracker.release({25, 5});
    ASSERT_TRUE(std::holds_alternative<Drag>(drag));
    EXPECT_EQ(std::get<Drag>(drag).to, cv::Point(25, 5));
    tracker.press({5, 5});
    for (int i = 0; i < 30; ++i) tracker.move();  // a magnified window is moved
    EXPECT_TRUE(std::holds_alternative<std::monostate>(tracker.release({5, 5})));
}

}  // namespace
}  // namespace goalmouth
