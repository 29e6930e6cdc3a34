#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "tests/support/evaluate_command.h"
#include "tests/support/files.h"
#include "tools/evaluate/file_hash.h"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace goalmouth {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

struct Merge : test::EvaluateCommand {
    void SetUp() override {
        frames_per_cell = "1";
        for (int part = 1; part <= 4; ++part) {
            const std::string name = std::to_string(part) + ".json";
            shards.push_back(path(name));
            ASSERT_EQ(small_paper(name, {"--scene", "flat,match", "--shard", std::to_string(part) + "/4"}),
                      0);
        }
    }
    int merge(std::vector<std::string> files, const std::string& target, bool partial = false) {
        files.insert(files.begin(), "merge");
        files.insert(files.end(), {"--json", path(target)});
        if (partial) files.emplace_back("--partial");
        return run(files);
    }
    std::string refused(std::vector<std::string> files) {
        files.insert(files.begin(), "merge");
        files.insert(files.end(), {"--json", path("out.json")});
        return refusal(files);
    }

    std::vector<std::string> shards;
};

TEST_F(Merge, GivesTheWholeRunBitForBit) {
    ASSERT_EQ(small_paper("whole.json", {"--scene", "flat,match"}), 0);
    ASSERT_EQ(merge({shards[2], shards[0], shards[3], shards[1]}, "merged.json"), 0);
    const Json whole = json("whole.json");
    const Json merged = json("merged.json");
    for (const char* part : {"cells", "tilts", "frames"}) EXPECT_TRUE(whole[part] == merged[part]) << part;
    const auto without_command = [](std::string file) {
        const auto at = file.find("\n \"command\"");
        return file.erase(at, file.find('\n', at + 1) - at);
    };
    EXPECT_TRUE(without_command(text("whole.json")) == without_command(text("merged.json")));
    EXPECT_THAT(printed, HasSubstr("ransac, scene flat"));
}

TEST_F(Merge, SplitsFramesAmongShards) {
    std::size_t frames = 0;
    for (int part = 1; part <= 4; ++part) {
        const Json j = json(std::to_string(part) + ".json");
        EXPECT_EQ(j["shard"], std::to_string(part) + "/4");
        EXPECT_TRUE(j["complete"].get<bool>());
        frames += j["frames"].size();
    }
    EXPECT_EQ(frames, 1U * 18U * 2U * 2U);
}

TEST_F(Merge, AsksForAllShardsUnlessPartial) {
    write("out.json", "old");
    const std::string said = refused({shards[0], shards[1], shards[3]});
    EXPECT_THAT(said, HasSubstr("3/4"));
    EXPECT_THAT(said, HasSubstr("9 of 36"));
    EXPECT_TRUE(text("out.json") == "old");
    ASSERT_EQ(merge({shards[0], shards[1], shards[3]}, "part.json", true), 0);
    EXPECT_FALSE(json("part.json")["complete"].get<bool>());
    ASSERT_EQ(merge({shards[2], path("part.json")}, "all.json"), 0);
    EXPECT_TRUE(json("all.json")["complete"].get<bool>());
}

TEST_F(Merge, RefusesTheSameFramesTwice) {
    const std::string said = refused({shards[0], shards[1], shards[0]});
    EXPECT_THAT(said, HasSubstr("1.json"));
    EXPECT_THAT(said, HasSubstr("already"));
}

TEST_F(Merge, RefusesPartsOfAnotherWhole) {
    const auto other = [&](const std::vector<std::string>& more) {
        std::vector<std::string> with = {"--shard", "2/4"};
        with.insert(with.end(), more.begin(), more.end());
        EXPECT_EQ(small_paper("other.json", with), 0);
        return refused({shards[0], path("other.json")});
    };
    for (const auto& [more, what] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--scene", "flat,match", "--seed", "9"}, "seed"},
             {{"--scene", "flat,match", "--set", "detection.ransac.attempts=7"}, "settings"},
             {{"--scene", "flat,match", "--detectors", "ransac"}, "detectors"},
             {{"--scene", "flat"}, "scene"},
             {{"--scene", "flat,lit"}, "scene"}}) {
        const std::string said = other(more);
        EXPECT_THAT(said, HasSubstr("other.json"));
        EXPECT_THAT(said, HasSubstr(what));
    }
    size = "320x240";
    EXPECT_THAT(other({"--scene", "flat,match"}), testing::AllOf(HasSubstr("other.json"), HasSubstr("size")));
    Json j = json("2.json");
    j["version"] = "0.0.0";
    write("other.json", j.dump());
    EXPECT_THAT(refused({shards[0], path("other.json")}), HasSubstr("version"));
}

TEST_F(Merge, RefusesAnotherColourTableOfTheSameName) {
    std::filesystem::create_directory(path("elsewhere"));
    ColourTable table(5, "mine");
    save_colour_table(table, path("mine.gmct"));
    const auto part = [&](const std::string& name, const std::string& shard, const std::string& colours) {
        ASSERT_EQ(small_paper(name, {"--shard", shard, "--colours", path(colours)}), 0);
    };
    part("a.json", "1/2", "mine.gmct");
    save_colour_table(table, path("elsewhere/mine.gmct"));
    part("b.json", "2/2", "elsewhere/mine.gmct");
    EXPECT_EQ(merge({path("a.json"), path("b.json")}, "both.json"), 0) << "the same content elsewhere";
    table.set({128, 60, 200}, Colour::goal);
    save_colour_table(table, path("elsewhere/mine.gmct"));
    part("b.json", "2/2", "elsewhere/mine.gmct");
    const std::string said = refused({path("a.json"), path("b.json")});
    EXPECT_THAT(said, HasSubstr("b.json"));
    EXPECT_THAT(said, HasSubstr("settings"));
}

TEST_F(Merge, KnowsTheContentOfTheGraphsColourTables) {
    const Json settings = json("1.json")["settings"]["detectors"]["ransac"]["segmentation"];
    EXPECT_EQ(settings["colours"], "simulator.gmct");
    EXPECT_EQ(settings["colours.fnv1a"].get<std::string>().size(), 16U);
}

TEST(FileHash, IsFnv1a) {
    const test::TemporaryFolder folder;
    test::write_text(folder.path() / "a", "a");
    test::write_text(folder.path() / "foobar", "foobar");
    EXPECT_EQ(file_hash(folder.path() / "a"), "af63dc4c8601ec8c");
    EXPECT_EQ(file_hash(folder.path() / "foobar"), "85944171f73967e8");
    EXPECT_THROW(file_hash(folder.path() / "missing"), FileError);
}

TEST_F(Merge, NamesTheFileThatIsNoResult) {
    const auto named = [&](const std::string& content) {
        write("bad.json", content);
        const std::string said = refused({shards[0], path("bad.json")});
        EXPECT_THAT(said, HasSubstr("bad.json")) << content.substr(0, 80);
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    };
    named("");
    named("no JSON");
    named("{}");
    named("[1, 2]");
    named("{\"what\": \"something else\"}");
    named("{\"what\": \"paper\"}");
    named("{\"what\": \"localisation\"}");
    const std::string whole = text("2.json");
    named(whole.substr(0, whole.size() / 2));
    EXPECT_THAT(refused({shards[0], path("missing.json")}), HasSubstr("missing.json"));
    EXPECT_THAT(refused({folder.path().string()}), HasSubstr(folder.path().string()));

    const auto changed = [&](const std::function<void(Json&)>& change) {
        Json j = json("2.json");
        change(j);
        named(j.dump());
    };
    changed([](Json& j) { j["seed"] = "one"; });
    changed([](Json& j) { j["size"] = 7; });
    changed([](Json& j) { j["frames_per_cell"] = 0; });
    changed([](Json& j) { j["scenes"] = Json::array(); });
    changed([](Json& j) { j["shard"] = "9/4"; });
    changed([](Json& j) { j["settings"] = 3; });
    changed([](Json& j) { j["frames"] = 3; });
    changed([](Json& j) { j["frames"][0] = 3; });
    changed([](Json& j) { j["frames"][0][1] = 18; });
    changed([](Json& j) { j["frames"][0][2] = -1; });
    changed([](Json& j) { j["frames"][0][3] = 1; });
    changed([](Json& j) { j["frames"][0][4] = 0.5; });
    changed([](Json& j) { j["frames"][0][9] = "far"; });
    changed([](Json& j) { j["frames"].erase(0); });
    changed([](Json& j) { std::swap(j["frames"][0], j["frames"][4]); });
}

}  // namespace
}  // namespace goalmouth
