#include "core/imaging/colour_labels.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/run_verb.h"
#include "tools/goalmouth/annotations.h"
#include "tools/goalmouth/colours_train.h"
#include "tools/goalmouth/verbs.h"

#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/Error.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

using testing::HasSubstr;

const std::filesystem::path source_folder = GOALMOUTH_SOURCE_DIR;

class Colours : public testing::Test {
  protected:
    /// Runs `goalmouth colours ARGUMENTS…`. Throws what main would turn into an exit code.
    static int colours(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "colours");
        return test::run_verb(add_colours_verb, std::move(arguments));
    }
    static std::string error_of(const std::vector<std::string>& arguments) {
        try {
            colours(arguments);
        } catch (const ConfigurationError& error) {
            return error.what();
        }
        return "no error";
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(path(name)) << content;
        return path(name);
    }
    test::TemporaryFolder folder_;
};

TEST_F(Colours, TheShippedTablesAreWhatTheirRulesMake) {
    for (const std::string name : {"simulator", "simulator_white_goals"}) {
        const auto shipped = source_folder / "config/colours" / name;
        ASSERT_EQ(colours({"make", shipped.string() + ".yaml", "-o", path("t.gmct")}), 0);
        EXPECT_EQ(read_bytes(path("t.gmct")), read_bytes(shipped.string() + ".gmct")) << name;
    }
}

TEST_F(Colours, RuleFilesWithMistakesAreRefusedWithTheLine) {
    const auto error = [&](const std::string& text) {
        return error_of({"make", write("r.yaml", text), "-o", path("t.gmct")});
    };
    EXPECT_THAT(error("rules:\n  - {class: sky}\n"),
                HasSubstr("r.yaml:2: unknown class \"sky\"; valid: unclassified, field"));
    EXPECT_THAT(error("rules:\n  - {hue: [1, 2]}\n"), HasSubstr("without \"class\""));
    EXPECT_THAT(error("rules:\n  - {class: goal, red: [1, 2]}\n"), HasSubstr("unknown key \"red\""));
    EXPECT_THAT(error("rules:\n  - {class: goal, y: [1]}\n"), HasSubstr("[lowest, highest]"));
    EXPECT_THAT(error("rules:\n  - {class: goal, y: [20, 10]}\n"), HasSubstr("the lowest first"));
    EXPECT_THAT(error("rules:\n  - {class: goal, hue: [0, 400]}\n"), HasSubstr("0…360"));
    EXPECT_THAT(error("rules:\n  - {class: goal, y: [a, b]}\n"), HasSubstr("[lowest, highest]"));
    EXPECT_THAT(error("rules: 5\n"), HasSubstr("r.yaml:1"));
    EXPECT_THAT(error("bits: 9\nrules:\n  - {class: goal}\n"), HasSubstr("5, 6, 7 or 8"));
    EXPECT_THAT(error("bits: 6\n"), HasSubstr("holds no rule"));
    EXPECT_THAT(error("rule: []\n"), HasSubstr("unknown key \"rule\""));
    EXPECT_THAT(error("rules: [\n"), HasSubstr("r.yaml"));
    EXPECT_THAT(error("just text\n"), HasSubstr("not a rule file"));
    EXPECT_EQ(error("rules:\n  - {class: goal}\n"), "no error");
}

TEST_F(Colours, ShowConvertInfoAndSegmentWork) {
    const std::string table = (source_folder / "config/colours/simulator.gmct").string();
    EXPECT_EQ(colours({"show", table, "-o", path("t.png")}), 0);
    EXPECT_FALSE(cv::imread(path("t.png")).empty());
    EXPECT_EQ(colours({"info", table}), 0);
    EXPECT_EQ(colours({"convert", table, "--bits", "7", "-o", path("t7.gmct")}), 0);
    EXPECT_EQ(load_colour_table(path("t7.gmct")).bits(), 7);
    cv::imwrite(path("a.png"), cv::Mat(20, 30, CV_8UC3, cv::Scalar(34, 184, 226)));
    EXPECT_EQ(colours({"segment", table, path("a.png"), "-o", path("out")}), 0);
    const cv::Mat picture = cv::imread(path("out/a_segmented.png"));
    ASSERT_EQ(picture.size(), cv::Size(60, 20));
    EXPECT_EQ(picture.at<cv::Vec3b>(10, 45), cv::Vec3b(0, 230, 255)) << "goal yellow";
}

TEST_F(Colours, WhatTheUserCanMendIsSaid) {
    const std::string table = (source_folder / "config/colours/simulator.gmct").string();
    EXPECT_THAT(error_of({"show", path("none.gmct")}), HasSubstr("none.gmct: no such file"));
    EXPECT_THAT(error_of({"show", table, "-o", path("no/such/folder/t.png")}),
                HasSubstr("cannot be written"));
    EXPECT_THAT(error_of({"show", table, "-o", path("t.txt")}), HasSubstr("must end in .png"));
    EXPECT_THAT(error_of({"segment", table, path("a.png"), "-o", write("file", "x")}),
                HasSubstr("the folder " + path("file") + " cannot be made"));
    EXPECT_THAT(error_of({"segment", table, write("a.png", ""), "-o", path("out")}),
                HasSubstr("1 of 1 images"));
    EXPECT_THAT(error_of({"segment", table, path("x.yuyv"), "--size", "640", "-o", path("out")}),
                HasSubstr("--size"));
    EXPECT_THAT(error_of({"import", "gmu_2014", write("a.raw", "short"), "-o", path("t.gmct")}),
                HasSubstr("5 bytes"));
    EXPECT_THROW(colours({"import", "foreign", path("a.raw"), "-o", path("t.gmct")}), CLI::ParseError);
    EXPECT_THROW(colours({"convert", table, "--bits", "4", "-o", path("t.gmct")}), CLI::ParseError);
    EXPECT_THROW(colours({}), CLI::ParseError);
}

TEST_F(Colours, AnnotationsWithMistakesAreRefused) {
    const auto error = [&](const std::string& text, const std::string& fold = "") {
        std::vector<std::string> arguments = {"train", "--annotations", write("a.json", text), "--set", "s",
                                              "-o",    path("t.gmct")};
        if (!fold.empty()) arguments.insert(arguments.end(), {"--fold", fold});
        return error_of(arguments);
    };
    EXPECT_THAT(error("{"), HasSubstr("not an annotation file"));
    EXPECT_THAT(error(R"({"images": [{"file": "x.png"}]})"), HasSubstr("not an annotation file"));
    EXPECT_THAT(error(R"({"images": [{"set": "other", "file": "x.png"}]})"), HasSubstr("valid: other"));
    EXPECT_THAT(error(R"({"images": [{"set": "s", "file": "x.png"}]})"), HasSubstr("x.png: no such file"));
    EXPECT_THAT(error("{}", "4/4"), HasSubstr("--fold"));
    EXPECT_THAT(
        error_of({"train", "--annotations", write("b.json", R"({"images": [{"set": "s", "file": "x.png"}]})"),
                  "--set", "s", "-o", path("t.gmct"), write("y.png", "")}),
        HasSubstr("says nothing about it"));
}

TEST(Fold, IsReadFromText) {
    ASSERT_TRUE(parse_fold("1/4"));
    EXPECT_EQ(parse_fold("1/4")->index, 1);
    EXPECT_EQ(parse_fold("1/4")->count, 4);
    for (const char* wrong : {"", "1", "4/4", "-1/4", "0/1", "1/4x", "a/b"})
        EXPECT_FALSE(parse_fold(wrong)) << wrong;
}

/// A table that never saw the pictures it is measured on.
void held_out_posts_are_found(const std::string& set, int fold) {
    GOALMOUTH_NEEDS_DATA(data);
    const test::TemporaryFolder folder;
    TrainColoursOptions options;
    options.annotations = data / "annotations.json";
    options.set = set;
    options.fold = Fold{fold, 4};
    options.output = folder.path() / "t.gmct";
    ASSERT_EQ(train_colours(options), 0);
    const ColourTable table = load_colour_table(options.output);
    GoalColourScore score;
    int index = 0;
    for (const AnnotatedImage& image : Annotations(options.annotations).usable_pictures(set)) {
        if (index++ % 4 == fold) score += score_goal_colour(load_scene(image), table);
    }
    ASSERT_GT(score.inside, 0);
    EXPECT_GE(static_cast<double>(score.inside_goal), 0.85 * static_cast<double>(score.inside));
    EXPECT_LE(static_cast<double>(score.elsewhere_goal), 0.005 * static_cast<double>(score.elsewhere));
}

TEST(TrainedTables, FindPostsOfDarwinOpImagesTheyNeverSaw) {
    held_out_posts_are_found("darwin_op_2014", 1);
}
TEST(TrainedTables, FindPostsOfNaoImagesTheyNeverSaw) {
    held_out_posts_are_found("nao_uva_2013", 1);
}

}  // namespace
}  // namespace goalmouth
