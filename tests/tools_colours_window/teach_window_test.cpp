#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "core/imaging/image_file.h"
#include "tests/core/colour_learning/drawn_pitch.h"
#include "tests/support/files.h"
#include "tests/tools_colours_window/display.h"
#include "tools/colours/teach_editor.h"
#include "tools/colours/teach_layout.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;
using test::Running;
using testing::HasSubstr;
using testing::Not;

class TeachWindow : public testing::Test {
  protected:
    void SetUp() override {
        if (const std::string problem = test::display_problem(); !problem.empty())
            GTEST_SKIP() << "skipped: " << problem;
        display_.emplace();
        drawn_ = test::draw_pitch({.ball = false, .things = 0}, 1);
        write_yuyv(path("pitch.yuyv"), drawn_.image.view());
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    std::unique_ptr<Running> teach(std::vector<std::string> more = {}) const {
        std::vector<std::string> command = {test::program("goalmouth"),
                                            "colours",
                                            "teach",
                                            path("pitch.yuyv"),
                                            "--size",
                                            "640x480",
                                            "-o",
                                            path("t.gmct")};
        command.insert(command.end(), more.begin(), more.end());
        return std::make_unique<Running>(command, test::new_mark());
    }

    /// Where the window shows this pixel of the picture.
    cv::Point place(cv::Point pixel) {
        TeachingSession session({drawn_.image});
        const TeachEditor editor(session, {"pitch.yuyv"}, [] { return ""; });
        const TeachLayout layout = layout_of(editor, display_->size());
        return layout.place_of(layout.picture, pixel);
    }
    /// The title once it says so.
    bool title(const std::string& end) {
        return display_->shows("^goalmouth colours teach - .*" + end + "$");
    }

    /// A first mark: what is joined to a pixel of the field.
    void fill_the_field(Running& window) {
        ASSERT_TRUE(title("0 marks")) << window.output();
        display_->point_at(place({320, 400}));
        display_->key("f");
        ASSERT_TRUE(title("field - fill - 0 marks"));
        display_->click(place({320, 400}));
        ASSERT_TRUE(title("1 mark, not saved"));
    }

    /// Share of the pixels of a class that a table calls so.
    double recall(const ColourTable& table, Colour colour) const {
        double all = 0.0, right = 0.0;
        const YuyvView image = drawn_.image.view();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                if (drawn_.truth.at<std::uint8_t>(y, x) != static_cast<std::uint8_t>(colour)) continue;
                all += 1.0;
                right += table.at(image.at(x, y)) == colour;
            }
        return right / all;
    }

    test::TemporaryFolder folder_;
    test::DrawnPicture drawn_;
    std::optional<test::Display> display_;
};

TEST_F(TeachWindow, MarksByMouseAndKeysMakeATable) {
    const auto window = teach();
    ASSERT_TRUE(title("pitch.yuyv - field - polygon - 0 marks")) << window->output();
    const cv::Rect post = drawn_.posts.front();
    // Fill: the carpet.
    display_->point_at(place({320, 400}));
    display_->key("f");
    ASSERT_TRUE(title("field - fill - 0 marks"));
    display_->click(place({320, 400}));
    ASSERT_TRUE(title("field - fill - 1 mark, not saved"));
    // Polygon: a post.
    display_->key("4");
    ASSERT_TRUE(title("goal - fill - 1 mark, not saved"));
    display_->key("p");
    ASSERT_TRUE(title("goal - polygon - 1 mark, not saved"));
    for (const cv::Point corner :
         {post.tl() + cv::Point(3, 20), cv::Point(post.br().x - 3, post.y + 20),
          cv::Point(post.br().x - 3, post.br().y - 40), cv::Point(post.x + 3, post.br().y - 40)})
        display_->click(place(corner));
    display_->key("Return");
    ASSERT_TRUE(title("goal - polygon - 2 marks, not saved"));
    // Box: the wall between the posts.
    display_->key("0");
    ASSERT_TRUE(title("unclassified - polygon - 2 marks, not saved"));
    display_->key("b");
    ASSERT_TRUE(title("unclassified - box - 2 marks, not saved"));
    display_->drag(place({post.br().x + 20, post.y + 40}), place({post.br().x + 100, post.y + 90}));
    ASSERT_TRUE(title("unclassified - box - 3 marks, not saved"));
    display_->key("u");
    ASSERT_TRUE(title("2 marks, not saved"));
    display_->key("r");
    ASSERT_TRUE(title("3 marks, not saved"));
    // A right click takes away what is under the pointer.
    display_->click(place({320, 400}), 3);
    ASSERT_TRUE(title("2 marks, not saved"));
    display_->key("u");
    ASSERT_TRUE(title("3 marks, not saved"));
    EXPECT_FALSE(fs::exists(path("t.gmct")));
    display_->key("s");
    ASSERT_TRUE(title("3 marks"));
    display_->key("q");
    EXPECT_EQ(window->wait(), 0) << window->output();

    const ColourTable table = load_colour_table(path("t.gmct"));
    EXPECT_GT(recall(table, Colour::field), 0.97);
    EXPECT_GT(recall(table, Colour::goal), 0.95);
    EXPECT_GT(recall(table, Colour::unclassified), 0.97);
    EXPECT_EQ(table.name(), "t");

    // What was saved replays: the same bytes without a window.
    ::unsetenv("DISPLAY");
    Running replay({test::program("goalmouth"), "colours", "teach", path("t.marks"), "--size", "640x480",
                    "-o", path("again.gmct"), "--name", "t"},
                   test::new_mark());
    EXPECT_EQ(replay.wait(), 0) << replay.output();
    EXPECT_EQ(read_bytes(path("again.gmct")), read_bytes(path("t.gmct")));
}

TEST_F(TeachWindow, GoesOnFromTheMarksOfBeforeAndAsksBeforeItGivesUpNewOnes) {
    test::write_text(path("t.marks"), "pitch.yuyv field fill 320 400 10\n");
    const std::string before = test::read_text(path("t.marks"));
    const auto window = teach();
    ASSERT_TRUE(title("field - polygon - 1 mark")) << window->output();
    display_->point_at(place({320, 400}));
    display_->key("f");
    ASSERT_TRUE(title("field - fill - 1 mark"));
    display_->click(place({100, 470}));
    ASSERT_TRUE(title("field - fill - 2 marks, not saved"));
    display_->key("q");
    ASSERT_TRUE(title("2 marks, not saved: quit\\?"));
    display_->key("5");  // the question is forgotten
    ASSERT_TRUE(title("robot - fill - 2 marks, not saved"));
    display_->key("q");
    ASSERT_TRUE(title("2 marks, not saved: quit\\?"));
    display_->key("q");
    EXPECT_EQ(window->wait(), 0);
    EXPECT_THAT(window->output(), HasSubstr("are given up"));
    EXPECT_EQ(test::read_text(path("t.marks")), before);
    EXPECT_FALSE(fs::exists(path("t.gmct")));
}

TEST_F(TeachWindow, ClassesWithTheSameColoursLeaveTheOldTable) {
    test::write_text(path("t.gmct"), "the table in force");
    const auto window = teach();
    ASSERT_NO_FATAL_FAILURE(fill_the_field(*window));
    display_->key("5");
    ASSERT_TRUE(title("robot - fill - 1 mark, not saved"));
    display_->click(place({320, 400}));
    ASSERT_TRUE(title("2 marks, not saved"));
    display_->key("s");
    ASSERT_TRUE(title("2 marks"));  // the marks are saved
    EXPECT_EQ(test::read_text(path("t.gmct")), "the table in force");
    EXPECT_THAT(test::read_text(path("t.marks")), HasSubstr("pitch.yuyv robot fill "));
    display_->key("q");
    EXPECT_EQ(window->wait(), 0);
    EXPECT_THAT(window->output(), HasSubstr("t.gmct is not written"));
}

TEST_F(TeachWindow, ControlCWritesNothing) {
    const auto window = teach();
    ASSERT_NO_FATAL_FAILURE(fill_the_field(*window));
    window->signal(SIGINT);
    EXPECT_EQ(window->wait(), 130) << window->output();
    EXPECT_FALSE(fs::exists(path("t.gmct")));
    EXPECT_FALSE(fs::exists(path("t.marks")));
}

TEST_F(TeachWindow, SavesNothingWhereNothingIsMarked) {
    const auto window = teach();
    ASSERT_TRUE(title("0 marks")) << window->output();
    display_->point_at(place({320, 400}));
    display_->key("s");
    // OpenCV keeps one key alone: the next may come before the last was taken.
    EXPECT_TRUE(test::eventually([&] {
        display_->key("q");
        return !test::process_lives(window->pid());
    }));
    EXPECT_EQ(window->wait(), 0);
    EXPECT_THAT(window->output(), HasSubstr("t.gmct is not written"));
    EXPECT_FALSE(fs::exists(path("t.marks")));
}

TEST_F(TeachWindow, WithoutADisplayItSaysWhatToDoInstead) {
    for (const std::string display : {"", ":987"}) {
        ::setenv("DISPLAY", display.c_str(), 1);
        const auto window = teach();
        EXPECT_EQ(window->wait(), 2);
        EXPECT_THAT(window->output(), HasSubstr("no window can be opened here: DISPLAY"));
        EXPECT_THAT(window->output(), HasSubstr("text file instead"));
        EXPECT_THAT(window->output(), Not(HasSubstr("qt.qpa")));
        EXPECT_FALSE(fs::exists(path("t.gmct")));
    }
}

}  // namespace
}  // namespace goalmouth
