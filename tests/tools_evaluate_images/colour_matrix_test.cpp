#include "tools/evaluate/colour_matrix.h"

#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "tests/core/colour_learning/drawn_pitch.h"
#include "tests/support/evaluate_command.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

/// Two venues, one in daylight and one in the light of warm lamps, four pictures each.
class ColourMatrix : public test::EvaluateCommand {
  protected:
    ColourMatrix() {
        Json annotations;
        annotations["images"] = Json::array();
        for (const std::string set : {"day", "warm"}) {
            test::DrawnPitch pitch;
            pitch.things = 0;
            if (set == "warm") pitch.light = {1.1, 0.8, 0.3};
            for (unsigned n = 0; n < 4; ++n) {
                const test::DrawnPicture picture = test::draw_pitch(pitch, n);
                const std::string name = set + std::to_string(n) + ".png";
                cv::imwrite(path(name), bgr_from_yuyv(picture.image.view()));
                Json posts = Json::array();
                for (const cv::Rect& box : picture.posts) {
                    const double left = box.x - 0.5, right = box.br().x - 0.5;
                    posts.push_back({{"base_left", {left, box.br().y}},
                                     {"base_right", {right, box.br().y}},
                                     {"top_left", {left, box.y}},
                                     {"top_right", {right, box.y}}});
                }
                annotations["images"].push_back({{"set", set}, {"file", name}, {"posts", posts}});
            }
        }
        write("annotations.json", annotations.dump());
        save_colour_table(ColourTable(6, "knows nothing"), path("empty.gmct"));
    }
};

TEST_F(ColourMatrix, HasEachTableOnEachSet) {
    ASSERT_EQ(run({"colours", folder.path().string(), "--detectors", "ransac", "--folds", "2", "--table",
                   path("empty.gmct"), "--json", path("out.json")}),
              0);
    const Json matrix = Json::parse(text("out.json"))["matrix"];
    ASSERT_EQ(matrix.size(), 10U);  // two sets, with and without annotations, and the table that was there
    for (const Json& cell : matrix) {
        EXPECT_EQ(cell["posts"], 8);
        const bool own = cell["of_set"] == cell["set"];
        if (cell["learnt_from"] == "") {
            EXPECT_EQ(cell["found"], 0);
        } else if (own) {
            EXPECT_GE(cell["recall"].get<double>(), 0.85) << cell.dump();
        }
    }
}

/// Ctrl-C: what is in hand is done, no further table is learnt.
TEST_F(ColourMatrix, EndsBetweenTablesWhereItIsAskedTo) {
    ColourMatrixOptions options;
    options.images.folder = folder.path();
    options.images.detectors = {"ransac"};
    options.images.folds = 2;
    options.tables = {path("empty.gmct")};
    EXPECT_TRUE(colour_matrix(options, {.expect = {}, .step = {}, .stop = [] { return true; }}).empty());

    bool looked_at_one = false;
    const auto rows = colour_matrix(
        options,
        {.expect = {}, .step = [&] { looked_at_one = true; }, .stop = [&] { return looked_at_one; }});
    ASSERT_EQ(rows.size(), 1U);
    ASSERT_EQ(rows[0].sets.size(), 1U);
    EXPECT_FALSE(rows[0].sets[0].complete);
}

/// Learning a set's tables is left off as well: these pictures would be an error.
TEST_F(ColourMatrix, EndsBetweenTheTablesOfASet) {
    for (unsigned n = 0; n < 4; ++n)
        cv::imwrite(path("day" + std::to_string(n) + ".png"), cv::Mat::zeros(480, 640, CV_8UC3));
    ImagesOptions options;
    options.folder = folder.path();
    options.detectors = {"ransac"};
    options.without_labels = true;
    options.sets = {"day"};
    EXPECT_THAT(test::message_of([&] { evaluate_images(options); }), HasSubstr("shows a field"));
    int asked = 0;
    const auto results =
        evaluate_images(options, {.expect = {}, .step = {}, .stop = [&] { return ++asked > 1; }});
    ASSERT_EQ(results.size(), 1U);
    EXPECT_FALSE(results[0].complete);
}

TEST_F(ColourMatrix, SaysWhatIsWrongWithATable) {
    const auto error = [&](const std::string& table) {
        return test::message_of([&] { run({"colours", folder.path().string(), "--table", table}); });
    };
    EXPECT_THAT(error(path("none.gmct")), HasSubstr("none.gmct"));
    EXPECT_THAT(error("gmu_2014:" + path("annotations.json")), HasSubstr("--table"));
}

/// One picture of four posts of which so many are found.
ColourMatrixRow row(const std::string& learnt, const std::string& from, std::size_t found) {
    ScoredPicture picture;
    picture.detector = "ransac";
    picture.truth.resize(4);
    picture.matching.found.resize(4);
    for (std::size_t i = 0; i < found; ++i) picture.matching.found[i] = i;
    picture.matching.verdicts.assign(found, Verdict::found);
    ImageSetResult set;
    set.set = "here";
    set.pictures.push_back(picture);
    return {"table", learnt, from, {set}};
}

TEST(LearningHere, IsHeldAgainstTheBestTableThatWasThere) {
    const auto against = [](const std::vector<ColourMatrixRow>& rows) {
        return learning_here_against_others(rows, "here", "ransac");
    };
    EXPECT_EQ(against({row("pictures", "here", 3), row("", "", 2), row("", "", 0)}), 1);
    EXPECT_EQ(against({row("pictures", "here", 3), row("", "", 2), row("", "", 4)}), -1);
    EXPECT_EQ(against({row("pictures", "here", 3), row("", "", 3)}), 0);
    EXPECT_EQ(against({row("pictures", "elsewhere", 3), row("", "", 2)}), -1)
        << "learnt elsewhere is not learnt here";
    EXPECT_EQ(against({row("annotations", "here", 3), row("", "", 2)}), -1) << "nor is what a person marked";
}

}  // namespace
}  // namespace goalmouth
