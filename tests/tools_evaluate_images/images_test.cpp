#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "tests/support/evaluate_command.h"
#include "tests/support/post_scene.h"
#include "tools/evaluate/images_report.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>
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

TEST_F(Images, CompareEdgesWithOutlines) {
    for (Json& image : annotations["images"]) {
        image["posts"][0]["u_edge"] = 0.75;
        image["posts"][0]["base_left"][0] = image["posts"][0]["base_left"][0].get<double>() - 2.0;
        image["posts"][0]["top_left"][0] = image["posts"][0]["top_left"][0].get<double>() - 2.0;
    }
    write_annotations();
    ASSERT_EQ(evaluate({}), 0);
    const Json set = report()["sets"][0];
    ASSERT_EQ(set["edges"].size(), 1U);
    const Json& edges = set["edges"][0];
    EXPECT_EQ(edges["of"], "all");
    EXPECT_EQ(edges["posts"], 3);
    EXPECT_NEAR(edges["left"]["mean_px"].get<double>(), 2.0, 0.6);
    EXPECT_NEAR(edges["right"]["mean_px"].get<double>(), 0.0, 0.6);
    EXPECT_NEAR(edges["width"]["rms_px"].get<double>(), 2.0, 1.2);
    EXPECT_EQ(edges["annotation_sigma_px"], 0.75);
    EXPECT_THAT(printed, HasSubstr("0.75"));
    EXPECT_FALSE(set.contains("distances"));
    EXPECT_EQ(report()["pictures"][1]["posts"][0]["edge_errors_px"]["left"].size(), 3U);
}

/// The drawn pictures under names that tell a place from which the far goal's left post stands where it is
/// drawn: so far away as it is wide.
class PlacedImages : public Images {
  protected:
    PlacedImages() {
        field = write("field.yaml", "{post_diameter: 0.1}");
        for (std::size_t i = 0; i < 3; ++i) {
            Json& image = annotations["images"][i];
            const double left = image["posts"][0]["base_left"][0].get<double>();
            const double right = image["posts"][0]["base_right"][0].get<double>();
            const double distance = 0.1 * camera.fx / (right - left);
            // The same bearing, up to the rounding in the name.
            const double bearing = std::atan((camera.cx - 0.5 * (left + right)) / camera.fx);
            const int heading = static_cast<int>(std::lround(-bearing * 180.0 / std::numbers::pi));
            const std::string name = fmt::format("{}_{:.2f}_75_{}.png", i, 300.0 - 100.0 * distance, heading);
            std::filesystem::rename(path(image["file"]), path(name));
            image["file"] = name;
        }
        std::filesystem::rename(path("none.png"), path("3_0_0_0.png"));
        annotations["negatives"][0]["file"] = "3_0_0_0.png";
        write_annotations();
    }
    int evaluate_placed(std::vector<std::string> more) {
        more.insert(more.end(), {"--poses", poses, "--field", field});
        return evaluate(more);
    }

    // What a graph takes for 320 px where nothing else is said.
    Intrinsics camera = scaled_to(Intrinsics{}, 320, 240);
    std::string field;
    std::string poses = "drawn={}_{x_cm}_{y_cm}_{heading_deg}";
};

TEST_F(PlacedImages, CompareDistancesWithTheRobotsPlace) {
    ASSERT_EQ(evaluate_placed({}), 0);
    const Json set = report()["sets"][0];
    EXPECT_EQ(set["placement"]["posts"], 3);
    EXPECT_EQ(set["placement"]["unplaced"], 0);
    EXPECT_LT(set["placement"]["direction_rms_deg"].get<double>(), 0.6);
    ASSERT_EQ(set["distances"].size(), 1U);
    const Json& distances = set["distances"][0];
    EXPECT_EQ(distances["posts"], 3);
    EXPECT_LT(distances["relative_rms"].get<double>(), 0.06);
    EXPECT_EQ(distances["by_distance"].size(), 3U);
    EXPECT_EQ(report()["pictures"][0]["posts"][0]["goalpost"], 2);
    EXPECT_THAT(printed, HasSubstr("Distances, drawn"));

    // A post twice as thick is twice as far.
    field = write("thick.yaml", "{post_diameter: 0.2}");
    ASSERT_EQ(evaluate_placed({}), 0);
    const Json thick = report()["sets"][0]["distances"][0];
    EXPECT_NEAR(thick["relative_rms"].get<double>(), 1.0, 0.1);
    EXPECT_GT(thick["bias_m"].get<double>(), 0.5);
}

TEST_F(PlacedImages, ReportShowsDistancesAndTheWorst) {
    ASSERT_EQ(evaluate_placed({"--report", path("report")}), 0);
    const std::string page = text("report/index.html");
    EXPECT_THAT(page, HasSubstr("What limits this comparison"));
    EXPECT_THAT(page, HasSubstr("drawn, ransac, all: the worst 3 of 3"));
    EXPECT_TRUE(std::filesystem::exists(path("report/distances0.svg")));
    EXPECT_TRUE(std::filesystem::exists(path("report/distances0_errors.svg")));
}

TEST_F(PlacedImages, MistakesInPatternsAreNamed) {
    EXPECT_THAT(error_of({"--poses", "{x_cm}_{y_cm}_{heading_deg}"}), HasSubstr("SET=PATTERN"));
    EXPECT_THAT(error_of({"--poses", "drawm={}_{x_cm}_{y_cm}_{heading_deg}"}),
                HasSubstr("did you mean 'drawn'"));
    EXPECT_THAT(error_of({"--poses", "drawn={}_{x_cm}_{y_cm}_{headin_deg}"}),
                testing::AllOf(HasSubstr("--poses"), HasSubstr("heading_deg")));
    EXPECT_THAT(error_of({"--poses", "drawn=a{}_{x_cm}_{y_cm}_{heading_deg}"}),
                testing::AllOf(HasSubstr("0_"), HasSubstr("does not fit"), HasSubstr("aa_12.5")));
    EXPECT_THAT(error_of({"--poses", poses, "--poses", poses}), HasSubstr("twice"));
    EXPECT_THAT(error_of({"--field", path("no.yaml")}), HasSubstr("no.yaml"));
}

TEST_F(Images, ReportShowsFailuresAndEveryOverlay) {
    annotations["images"][0]["posts"] = Json::array();
    write_annotations();
    ASSERT_EQ(evaluate({"--report", path("report")}), 0);
    const std::string page = text("report/index.html");
    EXPECT_THAT(page, HasSubstr("post0"));
    EXPECT_THAT(page, testing::Not(HasSubstr("post1 ·")));
    EXPECT_THAT(page, HasSubstr("detected less outlined"));
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
