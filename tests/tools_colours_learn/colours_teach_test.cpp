#include "core/conversion/intrinsics.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "core/imaging/image_file.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/log_bus.h"
#include "core/messaging/typed.h"
#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/refusal.h"
#include "tests/support/stripes.h"
#include "tools/colours/marked_pictures.h"
#include "tools/colours/teach.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

using testing::HasSubstr;

class ColoursTeach : public testing::Test {
  protected:
    ColoursTeach() { cv::imwrite(path("p.png"), test::stripes_bgr()); }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    int teach(const std::string& boxes) const {
        test::write_text(path("boxes.txt"), boxes);
        TeachColoursOptions options;
        options.inputs = {path("boxes.txt")};
        options.output = path("t.gmct");
        return teach_colours(options);
    }
    std::string error_of(const std::string& boxes) const {
        return test::message_of([&] { teach(boxes); });
    }
    void expect_stripes_told(const ColourTable& table) const {
        const YuyvImage picture = read_image(path("p.png"));
        EXPECT_EQ(table.at(picture.view().at(10, 10)), Colour::field);
        EXPECT_EQ(table.at(picture.view().at(45, 10)), Colour::goal);
        EXPECT_EQ(table.at(picture.view().at(75, 10)), Colour::unclassified);
    }
    test::TemporaryFolder folder_;
};

TEST_F(ColoursTeach, EachBoxTeachesItsClass) {
    ASSERT_EQ(teach("# the carpet\np.png field 2 2 25 55\np.png goal 33 2 56 55  # a post\n\np.png "
                    "unclassified 64 2 86 55\n"),
              0);
    const ColourTable table = load_colour_table(path("t.gmct"));
    expect_stripes_told(table);
    ASSERT_FALSE(table.provenance().empty());
    EXPECT_THAT(table.provenance()[0], HasSubstr("3 marks of boxes.txt"));
}

TEST_F(ColoursTeach, MistakesAreSaidAndTheOldTableStays) {
    test::write_text(path("t.gmct"), "the table in force");
    EXPECT_THAT(error_of("p.png goal 33 2 56 55\np.png ball 33 2 56 55\n"),
                HasSubstr("were given the same colours"));
    EXPECT_THAT(error_of("p.png goal 33 2 56\n"),
                HasSubstr("boxes.txt:1: \"p.png goal 33 2 56\" is not PICTURE"));
    EXPECT_THAT(error_of("\np.png sky 1 1 2 2\n"),
                HasSubstr("boxes.txt:2: unknown class \"sky\"; valid: unclassified"));
    EXPECT_THAT(error_of("p.png goal 5 5 2 9\n"), HasSubstr("upper left"));
    EXPECT_THAT(error_of("p.png goal 5 5 90 9\n"), HasSubstr("beyond the picture, which is 90x60"));
    EXPECT_THAT(error_of("p.png goal 5 5 2147483647 2147483647\n"),
                HasSubstr("2147483647 is no place in a picture"));
    EXPECT_THAT(error_of("p.png goal -2147483648 5 9 9\n"),
                HasSubstr("-2147483648 is no place in a picture"));
    EXPECT_THAT(error_of("p.png goal 5 5 99999999999999999999 9\n"), HasSubstr("is not PICTURE"));
    EXPECT_THAT(error_of("p.png goal 5 5 1048576 1048576\n"),
                HasSubstr("beyond the picture, which is 90x60"));
    EXPECT_THAT(error_of("p.png goal polygon 5 5 90 9 9 9\n"),
                HasSubstr("boxes.txt:1: the polygon reaches beyond"));
    std::string corners = "p.png goal polygon";
    for (int i = 0; i <= 1000; ++i) corners += " " + std::to_string(i % 80) + " " + std::to_string(i % 50);
    EXPECT_THAT(error_of(corners + "\n"), HasSubstr("at most 1000 corners"));
    EXPECT_THAT(error_of(std::string("p.png goal\0 5 5 9 9\n", 21)), HasSubstr("no text"));
    EXPECT_THAT(error_of(std::string((1 << 24) + 1, '#')), HasSubstr("too large"));
    EXPECT_THAT(error_of("p.png " + std::string(200, 'x') + "\n"), HasSubstr("xx…\" is not PICTURE"));
    EXPECT_THAT(error_of("p.png goal fill 90 5 9\n"),
                HasSubstr("boxes.txt:1: the fill's seed reaches beyond"));
    EXPECT_THAT(error_of("p.png goal fill 9 5 900\n"), HasSubstr("boxes.txt:1: a tolerance is 0"));
    EXPECT_THAT(error_of("q.png goal 5 5 9 9\n"), HasSubstr("boxes.txt:1: "));
    EXPECT_THAT(error_of("none.lcmlog@3 goal 5 5 9 9\n"), HasSubstr("boxes.txt:1: "));
    EXPECT_THAT(error_of("# nothing\n"), HasSubstr("holds no box"));
    EXPECT_THAT(error_of("p.png unclassified 5 5 9 9\n"), HasSubstr("all marks are unclassified"));
    EXPECT_EQ(read_bytes(path("t.gmct")).size(), std::string("the table in force").size());
}

TEST_F(ColoursTeach, TheTableDoesNotTakeThePlaceOfItsMarks) {
    const std::string marks = "p.png goal 33 2 56 55\n";
    test::write_text(path("boxes.txt"), marks);
    TeachColoursOptions options;
    options.inputs = {path("boxes.txt")};
    options.output = folder_.path() / "." / "boxes.txt";
    EXPECT_THAT(test::message_of([&] { teach_colours(options); }), HasSubstr("would be overwritten"));
    EXPECT_EQ(read_bytes(path("boxes.txt")).size(), marks.size());
}

TEST_F(ColoursTeach, PolygonsAndFillsTeachAsBoxesDo) {
    ASSERT_EQ(teach("p.png field polygon 1 1 28 1 28 58 1 58\np.png goal fill 45 30 5\np.png unclassified "
                    "fill 75 30 5\n"),
              0);
    expect_stripes_told(load_colour_table(path("t.gmct")));
}

TEST_F(ColoursTeach, PicturesOfALogTeachToo) {
    {
        LogBus bus({.input = {}, .output = path("a log.lcmlog")});
        for (int n = 0; n < 3; ++n) {
            FrameInfo info;
            info.utime = 1'000'000 + 100'000 * n;
            info.seq = 10 + n;
            Intrinsics intrinsics;
            intrinsics.width = 90;
            intrinsics.height = 60;
            info.intrinsics = to_message(intrinsics);
            bus.set_time(info.utime);
            const cv::Mat black = cv::Mat::zeros(60, 90, CV_8UC3);
            const YuyvImage image = n == 1 ? read_image(path("p.png")) : yuyv_from_bgr(black);
            publish(bus, channels::image_tap, self_contained_yuyv(info, "c", image.view()));
        }
    }
    ASSERT_EQ(teach("\"a log.lcmlog@1\" goal fill 45 30 5\n\"a log.lcmlog@1\" field 2 2 25 55\n"), 0);
    const ColourTable table = load_colour_table(path("t.gmct"));
    const YuyvImage picture = read_image(path("p.png"));
    EXPECT_EQ(table.at(picture.view().at(10, 10)), Colour::field);
    EXPECT_EQ(table.at(picture.view().at(45, 10)), Colour::goal);
    EXPECT_THAT(error_of("\"a log.lcmlog@3\" goal fill 45 30 5\n"),
                HasSubstr("boxes.txt:1: " + path("a log.lcmlog") +
                          ": holds 3 pictures, numbered from 0; there is no number 3"));
}

/// A picture has one place among those that are shown, whatever its marks and the command line call it.
TEST_F(ColoursTeach, MarksFindThePicturesThatAreThere) {
    MarkedPictures marked;
    marked.pictures = learning_pictures({path("p.png")}, {}, 10);
    cv::imwrite(path("q.png"), cv::Mat(60, 90, CV_8UC3, cv::Scalar::all(90)));
    test::write_text(path("m.marks"), "./p.png goal 33 2 56 55\nq.png field 0 0 9 9\nq.png line 5 5 9 9\n");
    add_marks(marked, read_marks(path("m.marks")), path("m.marks"), {});
    ASSERT_EQ(marked.pictures.size(), 2U);
    ASSERT_EQ(marked.marks.size(), 3U);
    EXPECT_EQ(marked.marks[0].picture, 0U);
    EXPECT_EQ(marked.marks[1].picture, 1U);
    EXPECT_EQ(marked.marks[2].picture, 1U);
    const auto lines = lines_of(marked.marks, marked.pictures);
    EXPECT_EQ(lines[0].picture.file, path("p.png"));
    EXPECT_EQ(lines[2].colour, Colour::line);
}

TEST_F(ColoursTeach, BlackPicturesTeachNothing) {
    test::write_text(path("t.gmct"), "the table in force");
    cv::imwrite(path("p.png"), cv::Mat::zeros(60, 90, CV_8UC3));
    EXPECT_THAT(error_of("p.png goal 33 2 56 55\n"), HasSubstr("the picture is black"));
    EXPECT_EQ(test::read_text(path("t.gmct")), "the table in force");
}

TEST_F(ColoursTeach, ATableThatCannotBeWrittenIsSaid) {
    test::write_text(path("boxes.txt"), "p.png goal 33 2 56 55\n");
    TeachColoursOptions options;
    options.inputs = {path("boxes.txt")};
    options.output = path("no/folder/t.gmct");
    EXPECT_THAT(test::message_of([&] { teach_colours(options); }), HasSubstr("--output"));
    options.output = folder_.path();
    EXPECT_THAT(test::message_of([&] { teach_colours(options); }), HasSubstr("is a folder"));
}

TEST_F(ColoursTeach, InputsThatDoNotGoTogetherAreSaid) {
    test::write_text(path("boxes.txt"), "p.png goal 33 2 56 55\n");
    TeachColoursOptions options;
    options.output = path("t.gmct");
    options.inputs = {path("boxes.txt"), path("p.png")};
    EXPECT_THAT(test::message_of([&] { teach_colours(options); }), HasSubstr("a file of marks stands alone"));
    options.inputs = {path("none.png")};
    EXPECT_THAT(test::message_of([&] { teach_colours(options); }), HasSubstr("no such file or folder"));
    options.inputs = {path("p.png")};
    options.marks = path("t.gmct");
    EXPECT_THAT(test::message_of([&] { teach_colours(options); }), HasSubstr("marks need one of their own"));
}

}  // namespace
}  // namespace goalmouth
