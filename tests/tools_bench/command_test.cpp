#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tools/goalmouth/bench_options.h"

#include <cstdlib>
#include <filesystem>
#include <set>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

using nlohmann::json;
using test::read_text;
using test::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Ran {
    int exit_code = -1;
    std::string out;
    std::string err;
};

Ran run(const std::string& arguments) {
    const TemporaryFolder folder;
    const std::string out = (folder.path() / "out").string();
    const std::string err = (folder.path() / "err").string();
    const std::string program = GOALMOUTH_BINARY_DIR "/bin/goalmouth bench ";
    const int status = std::system((program + arguments + " >" + out + " 2>" + err).c_str());
    const auto text = [](const std::string& file) { return fs::file_size(file) == 0 ? "" : read_text(file); };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
}

const std::string tiny = "--only stages --frames 3 --repetitions 1 ";

TEST(BenchCommand, MeasuresTheStagesAndWritesEveryRow) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "bench.json";
    const fs::path report = folder.path() / "report";
    const Ran ran = run(tiny + "--size 160x120,320x240 --seed 5 --json " + file.string() + " --report " +
                        report.string());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, AllOf(HasSubstr("SIMD"), HasSubstr("compiler"), HasSubstr("160×120"),
                               HasSubstr("frame → posts ÷ LSD"), HasSubstr("same consensus")));

    const json result = json::parse(read_text(file));
    for (const char* key :
         {"command", "seed", "machine", "versions", "ratios", "frames", "stages", "points", "growth"})
        EXPECT_TRUE(result.contains(key)) << key;
    EXPECT_EQ(result["seed"], 5);
    EXPECT_EQ(result["command"],
              "goalmouth bench --only stages --size 160x120,320x240 --frames 3 --repetitions 1 "
              "--seed 5 --json " +
                  file.string() + " --report " + report.string());
    EXPECT_EQ(result["same_segments"], true);
    EXPECT_TRUE(result.contains("left_out"));
    EXPECT_EQ(result["ratios"][0]["size"], "320x240");
    EXPECT_EQ(result["ratios"][0]["spacing"], 8);
    EXPECT_THAT(result["ratios"][0]["verdict"],
                AllOf(HasSubstr("at 320x240"), HasSubstr("fewer than 120 frames: not cold")));
    EXPECT_THAT(ran.out, HasSubstr("Promised, and measured: 320x240, scan-lines every 8 px"));

    ASSERT_EQ(result["ratios"].size(), 9U);
    for (const json& ratio : result["ratios"]) {
        for (const char* key : {"name", "ours_ms", "other", "other_ms", "ratio", "bar", "stretch"})
            EXPECT_TRUE(ratio.contains(key)) << key;
        EXPECT_GT(ratio["ours_ms"], 0.0);
        EXPECT_DOUBLE_EQ(ratio["ratio"], ratio["ours_ms"].get<double>() / ratio["other_ms"].get<double>());
    }

    std::set<std::string> names;
    for (const json& stage : result["stages"]) {
        if (stage["size"] == "320x240") names.insert(stage["name"]);
        EXPECT_GT(stage["median_ms"], 0.0) << stage;
        EXPECT_LE(stage["min_ms"], stage["p25_ms"]);
        EXPECT_LE(stage["p25_ms"], stage["median_ms"]);
        EXPECT_LE(stage["median_ms"], stage["p75_ms"]);
        EXPECT_GE(stage["samples"], 3);
    }
    for (const char* name : {"read", "lookup", "hsv", "hsv_three_colours", "canny_hough", "lsd"})
        EXPECT_EQ(names.count(name), 1U) << name;
    for (const char* name :
         {"segments", "edge_segments", "naive_segments", "frame_to_posts", "border", "candidates", "ransac"})
        for (const char* spacing : {"_4", "_8", "_16"})
            EXPECT_EQ(names.count(std::string(name) + spacing), 1U) << name << spacing;

    ASSERT_EQ(result["refinement"].size(), 2U);
    const json& refinement = result["refinement"][1];
    EXPECT_EQ(refinement["size"], "320x240");
    EXPECT_GT(refinement["posts"], 0);
    EXPECT_GE(refinement["posts"], refinement["refined"]);
    EXPECT_GE(refinement["refined"], refinement["compared"]);
    EXPECT_GT(refinement["ours"]["median_ms"], 0.0);
    EXPECT_GT(refinement["full"]["median_ms"], 0.0);

    std::vector<int> counts;
    for (const json& row : result["points"]) {
        counts.push_back(row["points"]);
        EXPECT_EQ(row["same_consensus"], true) << row["points"];
    }
    EXPECT_THAT(counts, ElementsAre(50, 100, 200, 500, 1000));
    EXPECT_EQ(result["growth"]["spacing"].size(), 2U * 3U);
    EXPECT_EQ(result["growth"]["points"].size(), 5U);

    const std::string page = read_text(report / "index.html");
    EXPECT_THAT(page, AllOf(HasSubstr("frame → posts ÷ LSD"), HasSubstr("How it grows")));
    for (const char* figure : {"contenders-160x120", "spacing-320x240", "points"}) {
        EXPECT_TRUE(fs::exists(report / (std::string(figure) + ".svg"))) << figure;
        EXPECT_TRUE(fs::exists(report / (std::string(figure) + ".png"))) << figure;
    }
}

TEST(BenchCommand, TakesPicturesAtTheirOwnSize) {
    const TemporaryFolder folder;
    for (int i = 0; i < 2; ++i)
        test::write_grey_picture(folder.path() / (std::to_string(i) + ".png"), 100 + i, 192, 144);
    const fs::path file = folder.path() / "bench.json";
    const Ran ran = run(tiny + "--images " + folder.path().string() + " --json " + file.string());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json result = json::parse(read_text(file));
    EXPECT_EQ(result["frames"][0]["size"], "192x144");
    EXPECT_EQ(result["frames"][0]["different"], 2);
    EXPECT_GE(result["frames"][0]["frames"], 3);
}

TEST(BenchCommand, RestrictsSimdToWhatIsAsked) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "bench.json";
    const Ran any = run(tiny + "--size 160x120 --simd no_such_thing");
    EXPECT_EQ(any.exit_code, 2);
    EXPECT_THAT(any.err, HasSubstr("--simd"));
    // What it says it has works.
    const auto last = any.err.find_last_of(" ");
    ASSERT_NE(last, std::string::npos);
    std::string name = any.err.substr(last + 1);
    while (!name.empty() && !std::isalnum(static_cast<unsigned char>(name.back())) && name.back() != '_')
        name.pop_back();
    const Ran ran = run(tiny + "--size 160x120 --simd " + name + " --json " + file.string());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(json::parse(read_text(file))["machine"]["simd"], name);
}

TEST(BenchCommand, SaysWhatIsWrongAndExits2) {
    const std::pair<const char*, const char*> mistakes[] = {
        {"--size 640", "--size: \"640\""},
        {"--size 10x10", "64…8192"},
        {"--size 160x120,160x120", "named twice"},
        {"--size 100x300", "another shape"},
        {"--frames 0", "--frames"},
        {"--repetitions -1", "--repetitions"},
        {"--only half", "--only"},
        {"--fps 0", "--fps"},
        {"--seconds nan", "--seconds"},
        {"--scene nosuch", "no scene 'nosuch'"},
        {"--camera nosuch.yaml", "there is no file nosuch.yaml"},
        {"--colours nosuch.gmct", "nosuch.gmct"},
        {"--images /nosuch/folder", "/nosuch/folder"},
        {"--images . --size 160x120", "--size"},
        {"--json /nosuch/folder/file.json", "--json"},
        {"--simd AVX2", "--only stages"},
        {"--simd AVX2 --only graph", "--only stages"},
        {"--images . --scene flat", "--scene"},
        {"--sizes 640x480", "did you mean '--size'"}};
    for (const auto& [arguments, words] : mistakes) {
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments;
        EXPECT_THAT(ran.err, HasSubstr(words)) << arguments;
        EXPECT_THAT(ran.out, IsEmpty()) << arguments;
    }
}

TEST(BenchCommand, HelpNamesItsOptions) {
    const Ran ran = run("--help");
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_THAT(ran.out, AllOf(HasSubstr("--json"), HasSubstr("--images"), HasSubstr("--report")));
}

TEST(BenchArguments, AskForTheSameOptions) {
    BenchOptions options;
    options.json = "a b.json";
    options.only = "graph";
    options.sizes = "320x240";
    options.frames = 7;
    options.scene = "flat";
    options.repetitions = 2;
    options.simd = "AVX2";
    options.seconds = 0.1;
    options.frames_per_second = 12.5;
    options.seed = 18446744073709551615ULL;
    const auto words = bench_arguments(options);
    CLI::App app;
    BenchOptions parsed;
    add_bench_options(app, parsed);
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    EXPECT_EQ(bench_arguments(parsed), words);
    EXPECT_EQ(parsed.seed, options.seed);
    EXPECT_EQ(parsed.seconds, options.seconds);
    EXPECT_EQ(parsed.json, options.json);
    EXPECT_THAT(bench_arguments(BenchOptions{}), IsEmpty());
}

}  // namespace
}  // namespace goalmouth
