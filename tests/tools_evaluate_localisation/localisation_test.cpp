#include "tools/evaluate/localisation.h"

#include "core/process/configuration.h"
#include "core/process/paths.h"
#include "modules/simulator/simulator_module.h"
#include "tests/support/evaluate_command.h"
#include "tools/evaluate/localisation_data.h"
#include "tools/evaluate/localisation_run.h"
#include "tools/evaluate/localisation_summary.h"

#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

/// A small camera in a plain hall: what is looked at here does not depend on the pictures.
LocalisationOptions small_options() {
    LocalisationOptions options;
    options.runs = 2;
    options.seconds = 2.0;
    options.frames_per_second = 10.0;
    options.detectors = {{"histogram", "histogram", {}}, {"ransac", "ransac", {}}};
    options.simulation.formation.hall.posters = 0;
    options.simulation.formation.hall.spectators = 0;
    options.camera = scaled_to(Intrinsics{}, 320, 240);
    options.scene = "plain";
    return options;
}

std::string document(const LocalisationResult& result) {
    return localisation_json(result).dump();
}

TEST(Localisation, IsTheSameForAnyNumberOfJobs) {
    LocalisationOptions options = small_options();
    const std::string alone = document(evaluate_localisation(options));
    options.jobs = 2;
    EXPECT_EQ(document(evaluate_localisation(options)), alone);
}

TEST(Localisation, ShardsMergeToTheWhole) {
    LocalisationOptions options = small_options();
    options.runs = 3;
    options.seconds = 1.0;
    const LocalisationResult whole = evaluate_localisation(options);
    const TemporaryFolder folder;
    std::vector<std::filesystem::path> files;
    options.parts = 2;
    for (const int part : {2, 1}) {
        options.part = part;
        const LocalisationResult shard = evaluate_localisation(options);
        EXPECT_FALSE(shard.complete());
        files.push_back(folder.path() / (std::to_string(part) + ".json"));
        std::ofstream(files.back()) << document(shard);
    }
    const LocalisationResult merged = join_localisation(files);
    EXPECT_TRUE(merged.complete());
    EXPECT_EQ(document(merged), document(whole));
}

TEST(Localisation, EveryFrameHasAPoseAndEveryRunItsOwnNoise) {
    LocalisationOptions options = small_options();
    std::size_t expected = 0;
    std::size_t frames = 0;
    const LocalisationResult result = evaluate_localisation(
        options, {.expect = [&](std::size_t n) { expected = n; }, .step = [&] { ++frames; }, .stop = {}});
    EXPECT_EQ(expected, 2U * 21U);
    EXPECT_EQ(frames, expected);
    ASSERT_EQ(result.done.size(), 2U);
    for (const LocalisationRun& run : result.done) {
        EXPECT_EQ(run.frames, 21);
        EXPECT_EQ(run.times.size(), 11U);
        for (const DetectorWalk& walk : run.detectors) {
            EXPECT_EQ(walk.path.size(), run.times.size());
            EXPECT_GT(walk.walk.position_sigma, 0.0);
        }
    }
    EXPECT_NE(result.done[0].detectors[0].walk.position_error,
              result.done[1].detectors[0].walk.position_error);
    EXPECT_NE(result.done[0].detectors[0].walk.position_error,
              result.done[0].detectors[1].walk.position_error);
}

TEST(Localisation, OfARobotThatMeasuresExactlyEndsNearTheTruth) {
    LocalisationOptions options = small_options();
    options.runs = 1;
    options.seconds = 8.0;
    options.camera = Intrinsics{};
    options.detectors = {{"ransac", "ransac", {}}};
    options.simulation.walk.odometry = {0.0, 0.0, 0.0, 0.0};
    options.simulation.kinematics = {0.0, 0.0, 0.0};
    const LocalisationResult result = evaluate_localisation(options);
    const PoseQuality& end = result.done.at(0).detectors.at(0).end;
    RecordProperty("position_error", std::to_string(end.position_error));
    RecordProperty("heading_error", std::to_string(end.heading_error));
    // 1.2 cm and 0.005 rad were measured; four times as much is what full walks with every error show.
    EXPECT_LT(end.position_error, 0.05);
    EXPECT_LT(end.heading_error, 0.02);
    EXPECT_GT(result.done[0].detectors[0].posts, 40);
}

TEST(Localisation, StoppedKeepsTheRunsThatWereDone) {
    LocalisationOptions options = small_options();
    int frames = 0;
    const LocalisationResult result = evaluate_localisation(
        options, {.expect = {}, .step = [&] { ++frames; }, .stop = [&] { return frames > 25; }});
    ASSERT_EQ(result.done.size(), 1U);
    EXPECT_EQ(result.done[0].run, 0);
    EXPECT_FALSE(result.complete());
}

TEST(Localisation, WalksUntilTheRobotIsAtTheBall) {
    const WalkParameters walk;
    const Field field;
    const double seconds = walk_to_ball_seconds(walk, field);
    Walker walker(walk, field, paper_route(field), Random(1));
    walker.advance(seconds);
    const double near = (walker.pose().position() - Eigen::Vector2d(-1.2, 0.0)).norm();
    EXPECT_LT(near, 0.4);
    walker.advance(seconds + 1.0);
    EXPECT_GT((walker.pose().position() - Eigen::Vector2d(-1.2, 0.0)).norm(), near);
    WalkParameters standing;
    standing.gait.speed = 0.0;
    EXPECT_THROW(walk_to_ball_seconds(standing, field), ConfigurationError);
}

/// Results whose figures are known.
LocalisationResult drawn_up(const std::vector<double>& histogram, const std::vector<double>& ransac) {
    LocalisationResult result;
    result.runs = static_cast<int>(histogram.size());
    result.detectors = {"histogram", "ransac"};
    for (std::size_t i = 0; i < histogram.size(); ++i) {
        LocalisationRun run;
        run.run = static_cast<int>(i);
        run.frames = 10;
        for (const double error : {histogram[i], ransac[i]}) {
            DetectorWalk walk;
            walk.walk = walk.end = {error, 0.1 * error, 0.5 * error, 0.05 * error};
            walk.posts = 20;
            run.detectors.push_back(walk);
        }
        result.done.push_back(run);
    }
    return result;
}

TEST(LocalisationSummary, HasMeansSigmasAndTheShareOfLostRuns) {
    const auto summaries = summarise(drawn_up({0.2, 0.4, 0.6}, {0.1, 0.2, 0.3}));
    ASSERT_EQ(summaries.size(), 2U);
    EXPECT_NEAR(summaries[0].walk.position_error.mean, 0.4, 1e-12);
    EXPECT_NEAR(summaries[0].walk.position_error.sigma, 0.2, 1e-12);
    EXPECT_NEAR(summaries[0].end.heading_error.mean, 0.04, 1e-12);
    EXPECT_NEAR(summaries[0].lost, 1.0 / 3.0, 1e-12);
    EXPECT_EQ(summaries[1].lost, 0.0);
    EXPECT_EQ(summaries[1].posts_per_frame, 2.0);
}

TEST(LocalisationSummary, ComparesRunByRun) {
    // Halved in every run: drawing runs anew cannot change that.
    const auto halved = compare(drawn_up({0.2, 0.4, 0.9, 0.1}, {0.1, 0.2, 0.45, 0.05}));
    ASSERT_EQ(halved.size(), 1U);
    EXPECT_EQ(halved[0].detector, "ransac");
    EXPECT_EQ(halved[0].against, "histogram");
    for (const double v : {halved[0].walk_position_error.value, halved[0].walk_position_error.low,
                           halved[0].end_heading_sigma.high})
        EXPECT_NEAR(v, 0.5, 1e-12);
    const auto mixed = compare(drawn_up({0.2, 0.2, 0.2, 0.2}, {0.1, 0.3, 0.1, 0.3}));
    EXPECT_NEAR(mixed[0].walk_position_error.value, 0.0, 1e-12);
    EXPECT_LT(mixed[0].walk_position_error.low, -0.2);
    EXPECT_GT(mixed[0].walk_position_error.high, 0.2);
}

struct LocalisationVerb : test::EvaluateCommand {
    int localisation(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "localisation");
        return run(arguments);
    }
    std::string error_of(const std::vector<std::string>& arguments) {
        return test::message_of([&] { localisation(arguments); });
    }
};

TEST_F(LocalisationVerb, WritesJsonAndReportAndMerges) {
    for (const char* shard : {"1/2", "2/2"}) {
        ASSERT_EQ(localisation({"--runs", "2", "--seconds", "0.4", "--shard", shard, "--json",
                                path(std::string(1, shard[0]) + ".json"), "--jobs", "1"}),
                  0);
    }
    EXPECT_THAT([&] { merge_localisation({path("1.json")}, path("all.json"), "", false); },
                testing::ThrowsMessage<ConfigurationError>(HasSubstr("1 of 2 runs are missing")));
    EXPECT_THAT(
        [&] {
            merge_localisation({path("1.json"), path("1.json")}, path("all.json"), "", true);
        },
        testing::ThrowsMessage<ConfigurationError>(HasSubstr("holds run 0")));
    ASSERT_EQ(merge_localisation({path("1.json"), path("2.json")}, path("all.json"), path("report"), false),
              0);
    const auto all = json("all.json");
    EXPECT_EQ(all["what"], "localisation");
    EXPECT_EQ(all["runs_done"], 2);
    EXPECT_EQ(all["results"].size(), 2U);
    EXPECT_EQ(all["summaries"].size(), 3U);
    EXPECT_TRUE(std::filesystem::exists(path("report/index.html")));
}

TEST_F(LocalisationVerb, BothGoalsStandInEveryScene) {
    ASSERT_EQ(localisation({"--runs", "1", "--seconds", "0.1", "--scene", "lit", "--detectors", "ransac",
                            "--json", path("a.json")}),
              0);
    EXPECT_EQ(json("a.json")["settings"]["formation"]["hall"]["own_goal"], true);
}

TEST_F(LocalisationVerb, RefusesWhatCannotBe) {
    const std::string old = write("old.json", "old");
    const auto error = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--json", old});
        return error_of(more);
    };
    EXPECT_THAT(error({"--shard", "3/2"}), HasSubstr("--shard"));
    EXPECT_THAT(error({"--scene", "flatt"}), HasSubstr("flat"));
    EXPECT_THAT(error({"--detectors", "ransac,ransac"}), HasSubstr("named twice"));
    EXPECT_THAT(error({"--detectors", "ransacc"}), HasSubstr("ransac"));
    EXPECT_THAT(error({"--set", "localisation.no_key=1"}), HasSubstr("no_key"));
    EXPECT_THAT(error({"--field", path("none.yaml")}), HasSubstr("none.yaml"));
    EXPECT_THAT(error_of({}), HasSubstr("--json"));
    EXPECT_THAT([&] { merge_localisation({old}, path("m.json"), "", true); },
                testing::ThrowsMessage<ConfigurationError>(HasSubstr("old.json")));
    EXPECT_EQ(text("old.json"), "old");
}

TEST_F(LocalisationVerb, RansacIsBetterThanTheHistogramByAtLeastThePapersShare) {
    ASSERT_EQ(localisation({"--runs", "3", "--jobs", "2", "--json", path("a.json")}), 0);
    const auto all = json("a.json");
    ASSERT_EQ(all["runs_done"], 3);
    ASSERT_EQ(all["comparisons"].size(), 2U);
    const auto& ransac = all["comparisons"][0];
    EXPECT_EQ(ransac["detector"], "ransac");
    EXPECT_EQ(ransac["against"], "histogram");
    EXPECT_GE(ransac["walk"]["position_error"]["reduction"].get<double>(), 0.18);
    EXPECT_GE(ransac["walk"]["heading_error"]["reduction"].get<double>(), 0.29);
}

}  // namespace
}  // namespace goalmouth
