#include "tools/evaluate/paper.h"

#include "core/process/configuration.h"
#include "tests/support/evaluate_command.h"
#include "tools/goalmouth/interrupt.h"

#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>

#include <CLI/Error.hpp>
#include <gmock/gmock.h>

namespace goalmouth {
namespace {

using test::EvaluateCommand;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

using Paper = EvaluateCommand;

Json without_command(Json j) {
    j.erase("command");
    return j;
}

TEST_F(Paper, WritesEveryCellOfEveryDetectorAndScene) {
    ASSERT_EQ(small_paper("a.json", {"--scene", "flat,match"}), 0);
    const Json j = json("a.json");
    EXPECT_EQ(j["cells"].size(), 2U * 2U * 18U);
    EXPECT_EQ(j["tilts"].size(), 2U * 2U * 3U);
    EXPECT_EQ(j["frames"].size(), 2U * 18U * 2U * 2U);
    EXPECT_EQ(j["seed"], 1);
    EXPECT_EQ(j["size"], "160x120");
    EXPECT_TRUE(j["complete"].get<bool>());
    EXPECT_TRUE(j["shard"].is_null());
    EXPECT_FALSE(j["version"].get<std::string>().empty());
    EXPECT_THAT(j["command"].get<std::string>(), HasSubstr("--scene flat,match"));
    const Json& cell = j["cells"][0];
    for (const char* name :
         {"detector",        "scene",         "size",       "distance_cm", "tilt_deg",
          "frames",          "posts",         "detected",   "false_posts", "rmse_cm",
          "bias_cm",         "median_abs_cm", "p95_abs_cm", "bound_cm",    "rmse_to_bound",
          "median_to_bound", "bias_to_bar",   "both_edges", "good",        "normalised_error",
          "all_measured"})
        EXPECT_TRUE(cell.contains(name)) << name;
    EXPECT_EQ(cell["detector"], "histogram");
    EXPECT_EQ(cell["distance_cm"], 60);
    EXPECT_EQ(cell["frames"], 2);
    for (const Json& each : j["cells"]) {
        EXPECT_LE(each["detected"], each["posts"]);
        EXPECT_EQ(each["rmse_cm"].is_null(), each["measured"] == 0);
        EXPECT_EQ(each["all_measured"]["rmse_cm"], each["rmse_cm"]) << "none of these chains refines";
        EXPECT_TRUE(each["good"].is_null());
        EXPECT_TRUE(each["normalised_error"].is_null());
        EXPECT_TRUE(each["rmse_to_bound"].is_null() || each["rmse_to_bound"] > 0.0);
    }
    EXPECT_THAT(printed, HasSubstr("ransac, scene match"));
    EXPECT_THAT(printed, HasSubstr("290.90"));
}

TEST_F(Paper, PoolsATiltFromItsCells) {
    ASSERT_EQ(small_paper("a.json", {"--detectors", "ransac"}), 0);
    const Json j = json("a.json");
    for (const Json& tilt : j["tilts"]) {
        int posts = 0;
        int detected = 0;
        double squares = 0.0;
        int measured = 0;
        for (const Json& cell : j["cells"]) {
            if (cell["tilt_deg"] != tilt["tilt_deg"]) continue;
            posts += cell["posts"].get<int>();
            detected += cell["detected"].get<int>();
            measured += cell["measured"].get<int>();
            if (!cell["rmse_cm"].is_null())
                squares += cell["measured"].get<int>() * std::pow(cell["rmse_cm"].get<double>(), 2);
        }
        EXPECT_EQ(tilt["posts"], posts);
        EXPECT_EQ(tilt["detected"], detected);
        ASSERT_GT(measured, 0);
        EXPECT_NEAR(tilt["rmse_cm"].get<double>(), std::sqrt(squares / measured), 1e-9);
    }
}

TEST_F(Paper, IsTheSameForAnyNumberOfJobsAndWhenRepeated) {
    ASSERT_EQ(small_paper("one.json", {"--scene", "match", "--jobs", "1"}), 0);
    ASSERT_EQ(small_paper("two.json", {"--scene", "match", "--jobs", "2"}), 0);
    EXPECT_EQ(without_command(json("one.json")).dump(), without_command(json("two.json")).dump());
    const std::string first = text("two.json");
    ASSERT_EQ(small_paper("two.json", {"--scene", "match", "--jobs", "3"}), 0);
    EXPECT_EQ(text("two.json"), first);
}

TEST_F(Paper, DrawsOtherFramesForAnotherSeed) {
    ASSERT_EQ(small_paper("a.json", {"--detectors", "ransac"}), 0);
    ASSERT_EQ(small_paper("b.json", {"--detectors", "ransac", "--seed", "2"}), 0);
    EXPECT_NE(json("a.json")["frames"], json("b.json")["frames"]);
}

TEST_F(Paper, DoesNotLetOneDetectorOrSceneChangeAnother) {
    ASSERT_EQ(small_paper("both.json", {"--scene", "lit,flat"}), 0);
    ASSERT_EQ(small_paper("alone.json", {"--detectors", "ransac"}), 0);
    Json of_both = Json::array();
    const Json both = json("both.json");
    for (const Json& cell : both["cells"])
        if (cell["detector"] == "ransac" && cell["scene"] == "flat") of_both.push_back(cell);
    EXPECT_EQ(of_both.size(), 18U);
    EXPECT_TRUE(of_both == json("alone.json")["cells"]);
}

TEST_F(Paper, HandsSettingsToTheGraphsThatHaveThem) {
    ASSERT_EQ(small_paper("a.json", {"--set", "detection.ransac.attempts=10", "--set", "detection.bins=40"}),
              0);
    const Json j = json("a.json");
    EXPECT_EQ(j["settings"]["detectors"]["ransac"]["detection"]["ransac.attempts"], 10);
    EXPECT_EQ(j["settings"]["detectors"]["histogram"]["detection"]["bins"], 40);
    EXPECT_THAT(refusal({"paper", "--set", "detection.nonsense=1", "--json", path("b.json")}),
                HasSubstr("nonsense"));
    EXPECT_THAT(refusal({"paper", "--set", "nobody.key=1", "--json", path("b.json")}), HasSubstr("nobody"));
}

TEST_F(Paper, RefusesWhatCannotBeInOneSentence) {
    const auto refused = [&](const std::vector<std::string>& with) {
        std::vector<std::string> arguments = {"paper", "--json", path("out.json")};
        arguments.insert(arguments.end(), with.begin(), with.end());
        return refusal(arguments);
    };
    write("out.json", "old");
    for (const char* shard : {"0/4", "5/4", "x", "1", "1/", "/4", "-1/4", "1/0", "1/4/2", "1 /4"})
        EXPECT_THAT(refused({"--shard", shard}), HasSubstr(std::string("\"") + shard + "\"")) << shard;
    EXPECT_THAT(refused({"--detectors", "ransak"}), HasSubstr("did you mean 'ransac'"));
    EXPECT_THAT(refused({"--detectors", "ransac,ransac"}), HasSubstr("twice"));
    EXPECT_THAT(refused({"--detectors", "ransac,,tuned"}), HasSubstr("ransac,,tuned"));
    EXPECT_THAT(refused({"--scene", "flatt"}), HasSubstr("did you mean 'flat'"));
    EXPECT_THAT(refused({"--scene", "flat,flat"}), HasSubstr("twice"));
    EXPECT_THAT(refused({"--scene", "flat,"}), HasSubstr("flat,"));
    for (const char* wrong : {"big", "640", "640x", "0x480", "4x4", "-640x480", "640x480x2", "12000x9000"})
        EXPECT_THAT(refused({"--size", wrong}), HasSubstr(wrong)) << wrong;
    EXPECT_THAT(refused({"--size", "640x640"}), HasSubstr("another shape"));
    EXPECT_THAT(refused({"--camera", path("none.yaml")}), HasSubstr("none.yaml"));
    EXPECT_THAT(refused({"--field", path("none.yaml")}), HasSubstr("none.yaml"));
    EXPECT_THAT(refused({"--colours", path("none.gmct")}), HasSubstr("none.gmct"));
    EXPECT_TRUE(text("out.json") == "old");
    EXPECT_THAT(refusal({"paper"}), HasSubstr("--json"));
    EXPECT_THAT(refusal({"paper", "--json", path("no/such/out.json")}), HasSubstr("no/such"));
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--frames-per-cell", "0"},
                                                  {"--jobs", "0"},
                                                  {"--seed", "-1"},
                                                  {"--seed", "1.5"}})
        EXPECT_THROW(refused(wrong), CLI::ValidationError) << wrong[0];
    EXPECT_TRUE(text("out.json") == "old");
}

TEST_F(Paper, NamesTheSceneFileWithTheMistake) {
    write("hall.yaml", "hall: {wall: [1, 2]}\n");
    write("scene.yaml", "scene: hall.yaml\n");
    EXPECT_THAT(refusal({"paper", "--scene", path("scene.yaml"), "--json", path("a.json")}),
                HasSubstr("three levels"));
    write("empty.yaml", "least_inside: 0.5\n");
    EXPECT_THAT(refusal({"paper", "--scene", path("empty.yaml"), "--json", path("a.json")}),
                HasSubstr("empty.yaml"));
    write("wrong.yaml", "scene: hall.yaml\nview: {yaw: 9}\n");
    EXPECT_THAT(refusal({"paper", "--scene", path("wrong.yaml"), "--json", path("a.json")}),
                HasSubstr("wrong.yaml:2"));
}

/// A detector that finds nothing and raises a signal at its third frame.
Detector interrupting(int signal) {
    const auto frames = std::make_shared<std::atomic<int>>(0);
    return {"interrupting", [=]() -> DetectPosts {
                return [=](const DetectorInput&) {
                    if (++*frames == 3) std::raise(signal);
                    return std::vector<Post>{};
                };
            }};
}

TEST_F(Paper, KeepsWhatWasDoneWhenInterrupted) {
    for (const int signal : {SIGINT, SIGTERM}) {
        PaperOptions options;
        options.frames_per_cell = 2;
        options.size = "160x120";
        options.detectors = "ransac";
        PaperSetup setup = set_up_paper(options);
        setup.detectors = {interrupting(signal)};
        PaperTask task;
        task.json = path("cut.json");
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = evaluate_paper(options, setup, task);
        testing::internal::GetCapturedStdout();
        EXPECT_EQ(code, 130);
        EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("3 of 36 frames"));
        const Json j = json("cut.json");
        EXPECT_FALSE(j["complete"].get<bool>());
        EXPECT_EQ(j["frames"].size(), 3U);
        EXPECT_EQ(j["cells"][0]["frames"], 2);
        EXPECT_EQ(j["cells"][1]["frames"], 1);
        EXPECT_EQ(j["cells"][2]["frames"], 0);
        EXPECT_TRUE(j["cells"][2]["rmse_cm"].is_null());
    }
}

TEST(Interrupt, GivesTheSignalsBack) {
    struct sigaction before {};
    sigaction(SIGINT, nullptr, &before);
    {
        const Interrupt interrupt;
        EXPECT_FALSE(interrupt.requested());
        std::raise(SIGINT);
        EXPECT_TRUE(interrupt.requested());
    }
    struct sigaction after {};
    sigaction(SIGINT, nullptr, &after);
    EXPECT_EQ(before.sa_handler, after.sa_handler);
    EXPECT_FALSE(Interrupt().requested()) << "a new one starts anew";
}

}  // namespace
}  // namespace goalmouth
