#include "tools/colours/marks_file.h"

#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/refusal.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using testing::HasSubstr;

class MarksFile : public testing::Test {
  protected:
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::vector<MarkLine> read(const std::string& text) const {
        test::write_text(path("m.marks"), text);
        return read_marks(path("m.marks"));
    }
    std::string error_of(const std::string& text) const {
        return test::message_of([&] { read(text); });
    }
    test::TemporaryFolder folder_;
};

TEST_F(MarksFile, HoldsBoxesPolygonsAndFills) {
    const auto marks = read(
        "# a remark\n"
        "1.png field 2 3 25 55\r\n"
        "\n"
        "sub/2.png goal polygon 1 2 3 4 5 0  # a post\n"
        "match.lcmlog@12 line fill 7 8 20\n");
    ASSERT_EQ(marks.size(), 3U);
    EXPECT_EQ(marks[0].picture, (MarkedPicture{path("1.png"), std::nullopt}));
    EXPECT_EQ(marks[0].colour, Colour::field);
    EXPECT_EQ(marks[0].shape, MarkShape(MarkedBox{{2, 3, 24, 53}}));
    EXPECT_EQ(marks[0].line, 2);
    EXPECT_EQ(marks[1].picture.file, path("sub/2.png"));
    EXPECT_EQ(marks[1].shape, MarkShape(MarkedPolygon{{{1, 2}, {3, 4}, {5, 0}}}));
    EXPECT_EQ(marks[2].picture, (MarkedPicture{path("match.lcmlog"), 12U}));
    EXPECT_EQ(marks[2].shape, MarkShape(MarkedFill{{7, 8}, 20}));
    EXPECT_EQ(marks[2].line, 5);
}

TEST_F(MarksFile, ComesBackAsItWasWritten) {
    const std::vector<MarkLine> written = {
        {{path("1.png"), {}}, Colour::field, MarkedBox{{2, 3, 24, 53}}, 0},
        {{path("a \"b\" #c\\.png"), {}}, Colour::ball, MarkedFill{{7, 8}, 0}, 0},
        {{path("../elsewhere/2.png"), {}}, Colour::goal, MarkedPolygon{{{1, 2}, {3, 4}, {5, 0}}}, 0},
        {{path("my match.lcmlog"), 3}, Colour::unclassified, MarkedBox{{0, 0, 1, 1}}, 0},
        {{path("left@3.png"), {}}, Colour::robot, MarkedBox{{0, 0, 1, 1}}, 0},
    };
    const auto marks = read(marks_text(written, folder_.path()));
    ASSERT_EQ(marks.size(), written.size());
    for (std::size_t i = 0; i < marks.size(); ++i) {
        EXPECT_EQ(marks[i].picture.file.lexically_normal(), written[i].picture.file.lexically_normal());
        EXPECT_EQ(marks[i].picture.place, written[i].picture.place);
        EXPECT_EQ(marks[i].colour, written[i].colour);
        EXPECT_EQ(marks[i].shape, written[i].shape);
    }
}

TEST_F(MarksFile, ItsNamesCountFromWhereItStands) {
    const std::vector<MarkLine> marks = {
        {{path("pictures/1.png"), {}}, Colour::field, MarkedBox{{0, 0, 1, 1}}, 0}};
    EXPECT_THAT(marks_text(marks, folder_.path()), HasSubstr("\npictures/1.png field 0 0 0 0\n"));
    EXPECT_THAT(marks_text(marks, path("tables")), HasSubstr("\n../pictures/1.png field"));
}

TEST_F(MarksFile, ALinkKeepsItsName) {
    test::write_text(path("blob"), "");
    std::filesystem::create_symlink("blob", path("s.yuyv"));
    EXPECT_THAT(
        marks_text({{{path("s.yuyv"), {}}, Colour::field, MarkedBox{{0, 0, 1, 1}}, 0}}, folder_.path()),
        HasSubstr("\ns.yuyv field 0 0 0 0\n"));
}

TEST_F(MarksFile, MistakesAreToldWithTheirLine) {
    EXPECT_THAT(error_of("\n1.png goal polygon 1 2 3 4\n"), HasSubstr("m.marks:2: "));
    EXPECT_THAT(error_of("1.png goal polygon 1 2 3 4 5 6 7\n"), HasSubstr("is not PICTURE"));
    EXPECT_THAT(error_of("1.png goal fill 1 2\n"), HasSubstr("is not PICTURE"));
    EXPECT_THAT(error_of("1.png goal circle 1 2 3\n"), HasSubstr("is not PICTURE"));
    EXPECT_THAT(error_of("1.png goal 1 2 3 4x\n"), HasSubstr("is not PICTURE"));
    EXPECT_THAT(error_of("\"1.png goal 1 2 3 4\n"), HasSubstr("is not PICTURE"));
    EXPECT_THAT(error_of("1.png sky fill 1 2 3\n"), HasSubstr("unknown class \"sky\"; valid: unclassified"));
    EXPECT_THAT(error_of("1.png goal fill 1 -2 3\n"), HasSubstr("-2 is no place in a picture"));
    EXPECT_THAT(error_of("# nothing\n"), HasSubstr("holds no box or other mark"));
    EXPECT_THAT(test::message_of([&] { read_marks(path("none.marks")); }), HasSubstr("none.marks"));
    const std::vector<MarkLine> broken = {
        {{path("a\nb.png"), {}}, Colour::field, MarkedBox{{0, 0, 1, 1}}, 0}};
    EXPECT_THAT(test::message_of([&] { marks_text(broken, folder_.path()); }), HasSubstr("line's end"));
}

}  // namespace
}  // namespace goalmouth
