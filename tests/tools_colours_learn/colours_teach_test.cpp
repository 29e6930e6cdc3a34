#include "core/imaging/colour_table_file.h"
#include "core/imaging/image_file.h"
#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/refusal.h"
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
    ColoursTeach() {
        cv::Mat picture(60, 90, CV_8UC3, cv::Scalar(60, 120, 50));
        cv::rectangle(picture, {30, 0, 30, 60}, cv::Scalar(34, 184, 226), cv::FILLED);
        cv::rectangle(picture, {60, 0, 30, 60}, cv::Scalar(150, 158, 160), cv::FILLED);
        cv::imwrite(path("p.png"), picture);
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    int teach(const std::string& boxes) const {
        test::write_text(path("boxes.txt"), boxes);
        TeachColoursOptions options;
        options.boxes = path("boxes.txt");
        options.output = path("t.gmct");
        return teach_colours(options);
    }
    std::string error_of(const std::string& boxes) const {
        return test::message_of([&] { teach(boxes); });
    }
    test::TemporaryFolder folder_;
};

TEST_F(ColoursTeach, EachBoxTeachesItsClass) {
    ASSERT_EQ(teach("# the carpet\np.png field 2 2 25 55\np.png goal 33 2 56 55  # a post\n\np.png "
                    "unclassified 64 2 86 55\n"),
              0);
    const ColourTable table = load_colour_table(path("t.gmct"));
    const YuyvImage picture = read_image(path("p.png"));
    EXPECT_EQ(table.at(picture.view().at(10, 10)), Colour::field);
    EXPECT_EQ(table.at(picture.view().at(45, 10)), Colour::goal);
    EXPECT_EQ(table.at(picture.view().at(75, 10)), Colour::unclassified);
    ASSERT_FALSE(table.provenance().empty());
    EXPECT_THAT(table.provenance()[0], HasSubstr("3 boxes of boxes.txt"));
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
    EXPECT_THAT(error_of("q.png goal 5 5 9 9\n"), HasSubstr("boxes.txt:1: "));
    EXPECT_THAT(error_of("# nothing\n"), HasSubstr("holds no box"));
    EXPECT_THAT(error_of("p.png unclassified 5 5 9 9\n"), HasSubstr("all boxes are unclassified"));
    EXPECT_EQ(read_bytes(path("t.gmct")).size(), std::string("the table in force").size());
}

}  // namespace
}  // namespace goalmouth
