#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "tests/support/evaluate_command.h"
#include "tests/support/post_scene.h"
#include "tools/evaluate/images_report.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

using Json = nlohmann::json;
using test::message_of;
using test::PostScene;
using testing::HasSubstr;

/// Pictures of one post each, at different places, and one without, annotated as they are drawn.
class Images : public test::EvaluateCommand {
  protected:
    Images() {
        annotations["images"] = Json::array();
        annotations["negatives"] = Json::array();
        for (int i = 0; i < 3; ++i) {
            PostScene scene;
            scene.post_left = 90 + 60 * i;
            scene.post_right = scene.post_left + 15 + 10 * i;
            draw(scene, "post" + std::to_string(i) + ".png");
            const double left = scene.post_left - 0.5;
            const double right = scene.post_right + 0.5;
            annotations["images"].push_back({{"set", "drawn"},
                                             {"file", "post" + std::to_string(i) + ".png"},
                                             {"posts",
                                              {{{"base_left", {left, scene.post_base}},
                                                {"base_right", {right, scene.post_base}},
                                                {"top_left", {left, scene.post_top}},
                                                {"top_right", {right, scene.post_top}}}}}});
        }
        PostScene none;
        none.post_top = none.post_base + 1;
        draw(none, "none.png");
        annotations["negatives"].push_back({{"set", "drawn"}, {"file", "none.png"}});
        save_colour_table(test::scene_table(), path("table.gmct"));
        write_annotations();
    }
    void draw(const PostScene& scene, const std::string& name) const {
        cv::imwrite(path(name), bgr_from_yuyv(test::scene_image(scene).view()));
    }
    void write_annotations() const { write("annotations.json", annotations.dump()); }
    int images(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "images");
        return run(arguments);
    }
    /// With the scene's table and one detector.
    int evaluate(std::vector<std::string> more) {
        more.insert(more.begin(), {folder.path().string(), "--detectors", "ransac", "--colours",
                                   path("table.gmct"), "--json", path("out.json")});
        return images(more);
    }
    std::string error_of(const std::vector<std::string>& more) {
        return message_of([&] { evaluate(more); });
    }
    Json report() const { return Json::parse(text("out.json")); }

    Json annotations;
};

TEST_F(Images, CountsWhatIsFoundMissedAndWrong) {
    // Something is marked where nothing is, and one post is not marked.
    annotations["images"][0]["posts"][0] = {
        {"base_left", {20, 140}}, {"base_right", {40, 140}}, {"top_left", {20, 20}}, {"top_right", {40, 20}}};
    write_annotations();
    ASSERT_EQ(evaluate({}), 0);
    const Json all = report();
    EXPECT_EQ(all["what"], "images");
    EXPECT_TRUE(all["complete"]);
    ASSERT_EQ(all["sets"].size(), 1U);
    const Json& set = all["sets"][0];
    EXPECT_EQ(set["set"], "drawn");
    EXPECT_EQ(set["pictures"], 4);
    EXPECT_EQ(set["posts"], 3);
    EXPECT_EQ(set["found"], 2);
    EXPECT_EQ(set["missed"], 1);
    EXPECT_EQ(set["wrong"], 1);
    EXPECT_EQ(set["negatives"], 1);
    EXPECT_EQ(set["wrong_on_negatives"], 0);
    EXPECT_NEAR(set["recall"].get<double>(), 2.0 / 3.0, 1e-12);
    // 16, 26 and 36 px wide, but for the one marked elsewhere with 20.
    std::vector<int> posts;
    for (const Json& one : set["by_width"]) posts.push_back(one["posts"].get<int>());
    EXPECT_EQ(posts, (std::vector<int>{0, 1, 1, 1, 0}));
    EXPECT_EQ(all["pictures"].size(), 4U);
}

TEST_F(Images, IgnoresWhatTheAnnotationsSay) {
    annotations["negatives"].push_back({{"set", "drawn"}, {"file", "post0.png"}});
    annotations["images"].erase(0);
    annotations["negatives"][1]["ignore"] = {{80, 0, 120, 240}};
    write_annotations();
    ASSERT_EQ(evaluate({}), 0);
    const Json set = report()["sets"][0];
    EXPECT_EQ(set["ignored"], 1);
    EXPECT_EQ(set["wrong"], 0);
}

TEST_F(Images, AreTheSameForAnyNumberOfJobs) {
    ASSERT_EQ(evaluate({"--jobs", "1"}), 0);
    const std::string alone = text("out.json");
    ASSERT_EQ(evaluate({"--jobs", "3"}), 0);
    EXPECT_EQ(text("out.json"), alone);
}

TEST_F(Images, LearnTablesFromTheOtherFolds) {
    ASSERT_EQ(
        images({folder.path().string(), "--detectors", "ransac", "--folds", "2", "--json", path("out.json")}),
        0);
    EXPECT_EQ(report()["sets"][0]["found"], 3);
    EXPECT_EQ(report()["colours"]["folds"], 2);
}

TEST_F(Images, TakeACameraForEachSet) {
    const std::string camera =
        write("camera.yaml", "{width: 640, height: 480, fx: 600, fy: 600, cx: 319.5, cy: 239.5}");
    ASSERT_EQ(evaluate({"--camera", "drawn=" + camera}), 0);
    EXPECT_EQ(report()["sets"][0]["camera"], camera);
    EXPECT_THAT(error_of({"--camera", "drawm=" + camera}), HasSubstr("did you mean 'drawn'"));
    EXPECT_THAT(error_of({"--camera", camera, "--camera", camera}), HasSubstr("twice"));
    EXPECT_THAT(error_of({"--camera", path("no.yaml")}), HasSubstr("no.yaml"));
}

TEST_F(Images, ReportShowsFailuresAndEveryOverlay) {
    annotations["images"][0]["posts"] = Json::array();
    write_annotations();
    ASSERT_EQ(evaluate({"--report", path("report")}), 0);
    const std::string page = text("report/index.html");
    EXPECT_THAT(page, HasSubstr("post0"));
    EXPECT_THAT(page, testing::Not(HasSubstr("post1 ·")));
    for (const char* name : {"post0", "post1", "post2", "none"}) {
        EXPECT_FALSE(cv::imread(path("report/overlays/drawn/ransac/" + std::string(name) + ".jpg")).empty())
            << name;
    }
}

TEST_F(Images, MistakesAreNamedAndLeaveOldResultsAlone) {
    ASSERT_EQ(evaluate({"--report", path("report")}), 0);
    const std::string old_json = text("out.json");
    const std::string old_page = text("report/index.html");
    const auto error = [&] { return error_of({"--report", path("report")}); };

    EXPECT_THAT(error_of({"--set", "drwan"}), HasSubstr("did you mean 'drawn'"));
    EXPECT_THAT(
        [&] {
            images({folder.path().string(), "--detectors", "ransak"});
        },
        testing::ThrowsMessage<ConfigurationError>(HasSubstr("ransak")));
    EXPECT_THAT(error_of({"--annotations", path("no.json")}), HasSubstr("no.json"));

    write("none.png", "no picture");
    EXPECT_THAT(error(), HasSubstr("none.png"));
    std::filesystem::remove(path("none.png"));
    EXPECT_THAT(error(), testing::AllOf(HasSubstr("annotations.json"), HasSubstr("none.png")));
    write("annotations.json", "{");
    EXPECT_THAT(error(), HasSubstr("annotations.json: not an annotation file"));
    write("annotations.json", "[]");
    EXPECT_THAT(error(), HasSubstr("annotations.json: not an annotation file"));
    std::filesystem::remove(path("annotations.json"));
    EXPECT_THAT(error(), HasSubstr("no annotations.json"));

    EXPECT_EQ(text("out.json"), old_json);
    EXPECT_EQ(text("report/index.html"), old_page);
}

TEST_F(Images, OfAnEmptyFolderOrNoneIsAMistake) {
    std::filesystem::create_directory(path("empty"));
    const auto error = [&](const std::string& where) { return message_of([&] { images({where}); }); };
    EXPECT_THAT(error(path("empty")), HasSubstr("empty: is empty"));
    EXPECT_THAT(error(path("nowhere")), HasSubstr("nowhere: no such folder"));
    EXPECT_THAT(error(path("post0.png")), HasSubstr("post0.png: is a file"));
}

TEST(ReferencePostOfAnOutline, EndsAtThePicturesBorder) {
    // Leans by 1 px in 10.
    const PostOutline outline{{100, 300}, {120, 300}, {160, -100}, {140, -100}};
    const ReferencePost post = reference_post(outline, 240);
    EXPECT_NEAR(post.left_top.x(), 130, 1e-9);
    EXPECT_NEAR(post.left_top.y(), 0, 1e-9);
    EXPECT_NEAR(post.right_base.y(), 239, 1e-9);
    EXPECT_NEAR(post.right_base.x(), 126.1, 1e-9);
}

}  // namespace
}  // namespace goalmouth
