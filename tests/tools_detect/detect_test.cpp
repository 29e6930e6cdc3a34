#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/post_scene.h"
#include "tests/support/run_verb.h"
#include "tools/goalmouth/verbs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/Error.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using nlohmann::json;

struct Detect : testing::Test {
    Detect() {
        save_colour_table(scene_table(), folder.path() / "table.gmct");
        write("graph.yaml",
              "seed: 3\nexternal: [IMAGE]\nprocesses:\n  - {name: segmentation, executable: segmentation}\n"
              "  - {name: extraction, executable: extraction}\n  - {name: detection, executable: "
              "detection_ransac}\n");
        write_yuyv(folder.path() / "scene.yuyv", scene_image().view());
        cv::imwrite(path("scene.png"), bgr_from_yuyv(scene_image().view()));
        write_yuyv(folder.path() / "lifelike.yuyv", lifelike_scene_image().view());
    }
    std::string path(const std::string& name) const { return (folder.path() / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

    /// The scene's graph with its posts refined, and localisation behind that.
    std::string refining() const {
        write("refined.yaml",
              "extends: graph.yaml\nexternal: [IMAGE, KINEMATICS, ODOMETRY]\nprocesses:\n"
              "  - {name: refinement, executable: refinement}\n"
              "  - {name: localisation, executable: localisation, channels: {POSTS: POSTS_REFINED}}\n");
        return path("refined.yaml");
    }
    /// Exit code of `goalmouth detect` with the scene's graph and table.
    int run(std::vector<std::string> arguments, std::string target = {}) const {
        if (target.empty()) target = path("out.json");
        arguments.insert(arguments.begin(), {"detect", "--json", target});
        if (with_table) arguments.insert(arguments.end(), {"--colours", path("table.gmct")});
        if (std::find(arguments.begin(), arguments.end(), "--graph") == arguments.end())
            arguments.insert(arguments.end(), {"--graph", path("graph.yaml")});
        return test::run_verb(add_detect_verb, std::move(arguments));
    }
    json report() const { return json::parse(std::ifstream(path("out.json"))); }

    TemporaryFolder folder;
    bool with_table = true;
};

TEST_F(Detect, ReportsPostBorderAndTimes) {
    ASSERT_EQ(run({path("scene.png")}), 0);
    const json j = report();
    ASSERT_EQ(j.size(), 1U);
    EXPECT_EQ(j[0]["file"], path("scene.png"));
    EXPECT_EQ(j[0]["width"], 320);
    EXPECT_EQ(j[0]["height"], 240);
    ASSERT_EQ(j[0]["posts"].size(), 1U);
    const json& post = j[0]["posts"][0];
    EXPECT_NEAR(post["left"][0][0].get<double>(), 149.5, 1.0);
    EXPECT_LT(post["left"][0][1].get<double>(), post["left"][1][1].get<double>());
    EXPECT_NEAR(post["right"][1][0].get<double>(), 165.5, 1.0);
    EXPECT_GT(post["distance_m"].get<double>(), 0.0);
    EXPECT_EQ(j[0]["border"].size(), 2U);
    for (const char* stage : {"segmentation", "extraction", "detection"})
        EXPECT_GT(j[0]["milliseconds"][stage].get<double>(), 0.0);
}

TEST_F(Detect, RefinesWhereTheGraphDoesUnlessToldNotTo) {
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", refining()}), 0);
    const json refined = report()[0];
    ASSERT_EQ(refined["posts"].size(), 1U) << "not the detector's and the refined one beside it";
    const json& post = refined["posts"][0];
    EXPECT_EQ(post["detector"], "detection_ransac refined");
    EXPECT_TRUE(post["refined"].get<bool>()) << post["refinement"]["reason"];
    EXPECT_EQ(post["refinement"]["reason"], "");
    EXPECT_GT(post["refinement"]["quality"].get<double>(), 0.5);
    EXPECT_FALSE(post["refinement"]["cues"].empty());
    EXPECT_GT(post["sigma_m"].get<double>(), 0.0);
    EXPECT_LT(post["sigma_m"].get<double>(), 0.1 * post["distance_m"].get<double>());
    EXPECT_NEAR(post["left"][1][0].get<double>(), 149.5, 0.3);
    EXPECT_GT(refined["milliseconds"]["refinement"].get<double>(), 0.0);
    EXPECT_FALSE(refined["milliseconds"].contains("localisation"));

    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240"}), 0);
    const json plain = report()[0];
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", refining(), "--no-refine"}), 0);
    EXPECT_EQ(report()[0]["posts"], plain["posts"]);
    EXPECT_FALSE(plain["posts"][0]["refined"].get<bool>());
    EXPECT_FALSE(plain["posts"][0].contains("refinement"));
    EXPECT_FALSE(report()[0]["milliseconds"].contains("refinement"));
    EXPECT_GT(plain["posts"][0]["sigma_m"].get<double>(), post["sigma_m"].get<double>());
}

TEST_F(Detect, RefinesPostsFoundByEdgesAlone) {
    with_table = false;
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", "edges_refined"}), 0);
    ASSERT_EQ(report()[0]["posts"].size(), 1U);
    const json post = report()[0]["posts"][0];
    EXPECT_TRUE(post["refined"].get<bool>()) << post["refinement"]["reason"];
    EXPECT_NEAR(post["left"][1][0].get<double>(), 149.5, 0.3);
    EXPECT_NEAR(post["right"][1][0].get<double>(), 165.5, 0.3);
}

TEST_F(Detect, OfAPictureDoesNotDependOnThoseBeforeWhenRefining) {
    const std::string graph = refining();
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", graph}), 0);
    const json alone = report()[0]["posts"];
    ASSERT_EQ(run({path("scene.yuyv"), path("lifelike.yuyv"), path("lifelike.yuyv"), "--size", "320x240",
                   "--graph", graph}),
              0);
    EXPECT_EQ(report()[1]["posts"], alone);
    EXPECT_EQ(report()[2]["posts"], alone);
}

TEST_F(Detect, RefinesWithTheCameraPoseWhereKnown) {
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", refining(), "--height", "0.4",
                   "--pitch", "0.1"}),
              0);
    EXPECT_TRUE(report()[0]["posts"][0]["refined"].get<bool>());
}

TEST_F(Detect, TextTellsARefinedDistanceToTheMillimetre) {
    testing::internal::CaptureStdout();
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", refining()}), 0);
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_NE(said.find("refined"), std::string::npos) << said;
}

TEST_F(Detect, DrawsRefinedEdges) {
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", refining(), "--overlay",
                   path("refined")}),
              0);
    ASSERT_EQ(run({path("lifelike.yuyv"), "--size", "320x240", "--graph", refining(), "--overlay",
                   path("plain"), "--no-refine"}),
              0);
    const cv::Mat refined = cv::imread(path("refined/lifelike.png"));
    const cv::Mat plain = cv::imread(path("plain/lifelike.png"));
    ASSERT_EQ(refined.size(), plain.size());
    EXPECT_GT(cv::norm(refined, plain, cv::NORM_L1), 0.0);
}

TEST_F(Detect, OfAPictureDoesNotDependOnThoseBefore) {
    ASSERT_EQ(run({path("scene.png")}), 0);
    const json alone = report()[0]["posts"];
    ASSERT_EQ(run({path("scene.yuyv"), path("scene.png"), path("scene.png"), "--size", "320x240"}), 0);
    EXPECT_EQ(report().size(), 3U);
    EXPECT_EQ(report()[1]["posts"], alone);
    EXPECT_EQ(report()[2]["posts"], alone);
}

TEST_F(Detect, GoesOnAfterAPictureThatCannotBeRead) {
    write("empty.png", "");
    write("text.png", "no picture");
    testing::internal::CaptureStderr();
    EXPECT_EQ(run({path("empty.png"), path("scene.png"), path("text.png"), path("missing.png")}), 2);
    const std::string said = testing::internal::GetCapturedStderr();
    for (const char* name : {"empty.png", "text.png", "missing.png"})
        EXPECT_NE(said.find(name), std::string::npos) << name;
    EXPECT_EQ(report().size(), 1U);
}

TEST_F(Detect, AnswersToTheSmallestPicture) {
    cv::imwrite(path("one.png"), cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 0, 0)));
    ASSERT_EQ(run({path("one.png")}), 0);
    EXPECT_EQ(report()[0]["posts"].size(), 0U);
    EXPECT_EQ(report()[0]["border"].size(), 0U);
}

TEST_F(Detect, ScalesTheCameraAndTakesTheField) {
    write("camera.yaml", "{width: 640, height: 480, fx: 600, fy: 600, cx: 319.5, cy: 239.5}");
    write("field.yaml", "post_diameter: 0.12");
    ASSERT_EQ(run({path("scene.png"), "--camera", path("camera.yaml"), "--field", path("field.yaml")}), 0);
    const json post = report()[0]["posts"][0];
    EXPECT_NEAR(post["distance_m"].get<double>(), 0.12 * 300 / post["width_px"].get<double>(), 1e-9);
}

TEST_F(Detect, SetsParametersOfOneStage) {
    ASSERT_EQ(run({"--set", "detection.ransac.attempts=60", "--set", "detection.ransac.minimum_points=1000",
                   path("scene.png")}),
              0);
    EXPECT_EQ(report()[0]["posts"].size(), 0U);
    EXPECT_THROW(run({path("scene.png"), "--set", "detection.no_such_key=1"}), ConfigurationError);
    EXPECT_THROW(run({path("scene.png"), "--set", "nobody.key=1"}), ConfigurationError);
}

TEST_F(Detect, SpacesScanLinesByTheCameraPoseWhereKnown) {
    ASSERT_EQ(run({path("scene.png"), "--height", "0.4", "--pitch", "0.3", "--set",
                   "segmentation.scan_lines.spacing=field"}),
              0);
    EXPECT_EQ(report()[0]["posts"].size(), 1U);
}

TEST_F(Detect, DrawsIntoAFolderOfItsOwn) {
    ASSERT_EQ(
        run({path("scene.png"), path("scene.yuyv"), "--size", "320x240", "--overlay", path("drawn/here")}),
        0);
    const cv::Mat drawn = cv::imread(path("drawn/here/scene.png"));
    const cv::Mat plain = cv::imread(path("scene.png"));
    ASSERT_EQ(drawn.size(), plain.size());
    EXPECT_GT(cv::norm(drawn, plain, cv::NORM_L1), 0.0);
    EXPECT_FALSE(cv::imread(path("drawn/here/scene_2.png")).empty());
}

TEST_F(Detect, RefusesAGraphWithoutADetectorAndFilesThatAreMissing) {
    write("none.yaml", "external: [IMAGE]\nprocesses:\n  - {name: segmentation, executable: segmentation}\n");
    EXPECT_THROW(run({path("scene.png"), "--graph", path("none.yaml")}), std::exception);
    EXPECT_THROW(run({path("scene.png"), "--camera", path("missing.yaml")}), ConfigurationError);
    EXPECT_THROW(run({path("scene.png"), "--field", path("missing.yaml")}), ConfigurationError);
    EXPECT_THROW(run({path("scene.yuyv"), "--size", "huge"}), ConfigurationError);
}

TEST_F(Detect, RefusesWhereItCannotWriteBeforeItWorks) {
    EXPECT_THROW(run({path("scene.png")}, path("no/such/folder.json")), ConfigurationError);
    EXPECT_THROW(run({path("scene.png")}, folder.path().string()), ConfigurationError);
    EXPECT_THROW(run({path("scene.png"), "--overlay", path("scene.png")}), ConfigurationError);
    EXPECT_THROW(run({path("scene.png"), "--overlay", path("drawn"), "--set", "a.b=1"}), ConfigurationError);
    EXPECT_FALSE(std::filesystem::exists(path("drawn"))) << "nothing is made where the graph is wrong";
}

TEST_F(Detect, TakesNumbersOnlyForTheCameraPose) {
    for (const char* wrong : {"nan", "inf", "high", "0", "-1"})
        EXPECT_THROW(run({path("scene.png"), "--height", wrong}), CLI::ValidationError) << wrong;
    EXPECT_THROW(run({path("scene.png"), "--height", "0.5", "--pitch", "nan"}), CLI::ValidationError);
    EXPECT_EQ(run({path("scene.png"), "--height", "0.5", "--pitch=-0.1"}), 0);
}

}  // namespace
}  // namespace goalmouth
