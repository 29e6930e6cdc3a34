#include "core/process/graph.h"

#include "core/process/graph_program.h"
#include "core/process/graph_value.h"
#include "tests/support/data.h"

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Programs that exist nowhere but here, and what they would answer.
bool describe_for_test(const std::string& executable, ProgramDescription& description) {
    static const std::map<std::string, ProgramDescription> programs = {
        {"source",
         {{"source", "makes images", {}, {{"IMAGE", "image_t", "", false}}},
          {{"frames_per_second", "30", "a number", "1/s", ""},
           {"walk.speed", "0.2", "a number", "m/s", ""},
           {"offsets", "[]", "a list of numbers", "m", ""},
           {"field", "f.yaml", "the name of a file", "", ""}}}},
        {"finder",
         {{"finder", "finds posts", {{"IMAGE", "image_t", "", false}}, {{"POSTS", "posts_t", "", false}}},
          {{"threshold", "3", "a number", "px", ""}, {"table", "t.gmct", "the name of a file", "", ""}}}},
        {"other_finder",
         {{"other_finder",
           "finds posts",
           {{"IMAGE", "image_t", "", false}},
           {{"POSTS", "posts_t", "", false}}},
          {}}},
        {"locator",
         {{"locator",
           "finds itself",
           {{"POSTS", "posts_t", "", false}, {"ODOMETRY", "odometry_t", "", true}},
           {{"POSE", "pose_t", "", false}}},
          {{"field", "f.yaml", "the name of a file", "", ""}}}},
        {"odd", {{"odd", "reads posts as poses", {{"POSTS", "pose_t", "", false}}, {}}, {}}},
        {"tap",
         {{"tap", "records", {{"IMAGE", "image_t", "", false}}, {{"IMAGE_TAP", "image_t", "", false}}},
          {{"every", "15", "a number", "1", ""}, {"encoding", "jpeg", "one of: raw, jpeg", "", ""}}}},
    };
    const auto found = programs.find(executable);
    if (found == programs.end()) return false;
    description = found->second;
    return true;
}

const char* const good_graph = R"(seed: 7
lcm_url: udpm://239.255.76.67:7667?ttl=0
common:
  field: fields/small.yaml
processes:
  - name: camera
    executable: source
    parameters: {frames_per_second: 15, walk: {speed: 0.1}}
  - name: detection
    executable: finder
  - name: localisation
    executable: locator
)";

class GraphFileTest : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        const auto file = folder_.path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text;
        return file;
    }

    static Graph load(const std::filesystem::path& file, GraphOptions options = {}) {
        options.describe = describe_for_test;
        return load_graph(file.string(), options);
    }

    Graph load_text(const std::string& text, GraphOptions options = {}) const {
        return load(write("graph.yaml", text), std::move(options));
    }

    /// The error that the text is answered with, its folder left out.
    std::string error_of(const std::string& text, GraphOptions options = {}) const {
        try {
            load_text(text, std::move(options));
        } catch (const ConfigurationError& error) {
            std::string what = error.what();
            const std::string folder = folder_.path().string() + "/";
            for (auto at = what.find(folder); at != std::string::npos; at = what.find(folder))
                what.erase(at, folder.size());
            return what;
        }
        return "no error";
    }

    /// The good graph with one text replaced by another.
    static std::string with(const std::string& old_text, const std::string& new_text) {
        std::string text = good_graph;
        const auto at = text.find(old_text);
        if (at == std::string::npos) throw std::logic_error("the good graph holds no " + old_text);
        return text.replace(at, old_text.size(), new_text);
    }

    test::TemporaryFolder folder_;
};

TEST_F(GraphFileTest, HoldsWhatTheFileSays) {
    const Graph graph = load(write("two/ransac.yaml", good_graph));
    EXPECT_EQ(graph.name, "ransac");
    EXPECT_EQ(graph.seed, 7U);
    EXPECT_EQ(graph.lcm_url, "udpm://239.255.76.67:7667?ttl=0");
    ASSERT_EQ(graph.processes.size(), 3U);
    EXPECT_EQ(graph.processes[0].name, "camera");
    EXPECT_EQ(graph.processes[0].executable, "source");
    EXPECT_EQ(graph.processes[0].place.line, 6);
    ASSERT_EQ(graph.processes[0].settings.size(), 3U);
    EXPECT_EQ(graph.processes[0].settings[0].key, "field");
    EXPECT_EQ(graph.processes[0].settings[1].value, "15");
    EXPECT_EQ(graph.processes[0].settings[2].key, "walk.speed");
    EXPECT_NE(graph.find("localisation"), nullptr);
    EXPECT_EQ(graph.find("nobody"), nullptr);
}

TEST_F(GraphFileTest, CommonValuesGoToThoseWhoHaveTheParameter) {
    const Graph graph = load_text(good_graph);
    EXPECT_EQ(graph.find("localisation")->settings.size(), 1U);
    EXPECT_TRUE(graph.find("detection")->settings.empty());
}

TEST_F(GraphFileTest, FileNamesCountFromTheGraphFile) {
    const Graph graph = load_text(good_graph);
    const auto line = command_line(graph, *graph.find("localisation"), "udpm://");
    EXPECT_THAT(line, testing::Contains("field=" + (folder_.path() / "fields/small.yaml").string()));
    EXPECT_THAT(line,
                testing::IsSupersetOf({"--name", "localisation", "--seed", "7", "--lcm-url", "udpm://"}));
}

TEST_F(GraphFileTest, ListsAndQuotedTextsReachTheProcessAsWritten) {
    const Graph graph =
        load_text(with("frames_per_second: 15", "frames_per_second: \"15\", offsets: [1, 2.5], field: ''"));
    const auto& settings = graph.find("camera")->settings;
    EXPECT_EQ(settings[1].value, "\"15\"");
    EXPECT_EQ(settings[2].value, "[1, 2.5]");
    EXPECT_THAT(command_line(graph, *graph.find("camera"), "udpm://"), testing::Contains("field=\"\""));
}

TEST_F(GraphFileTest, ProcessesThatAreNotEnabledAreLeftOut) {
    const Graph graph =
        load_text(std::string(good_graph) + "  - {name: second, executable: nowhere, enabled: false}\n");
    EXPECT_EQ(graph.processes.size(), 3U);
}

TEST_F(GraphFileTest, ChannelsAreRenamedForOneProcess) {
    const Graph graph =
        load_text(std::string(good_graph) +
                  "  - {name: second, executable: other_finder, channels: {POSTS: POSTS_2}}\n");
    EXPECT_EQ(graph.find("second")->channel("POSTS"), "POSTS_2");
    EXPECT_EQ(graph.find("second")->channel("IMAGE"), "IMAGE");
    EXPECT_THAT(command_line(graph, *graph.find("second"), "udpm://"), testing::Contains("POSTS=POSTS_2"));
}

TEST_F(GraphFileTest, ProgramsThatSayNothingOfThemselvesAreDescribedByTheGraph) {
    const Graph graph =
        load_text(with("executable: finder",
                       "executable: /bin/true\n    subscribes: [IMAGE]\n"
                       "    publishes: [{channel: POSTS, type: posts_t}]\n    arguments: [-v]\n"
                       "    parameters: {anything: 3}"));
    const GraphProcess& process = *graph.find("detection");
    EXPECT_FALSE(process.described);
    const auto line = command_line(graph, process, "udpm://");
    EXPECT_EQ(line.front(), "/bin/true");
    EXPECT_EQ(line.back(), "-v");
    EXPECT_THAT(line, testing::Contains("anything=3"));
}

TEST_F(GraphFileTest, ExtendingReplacesProcessesByName) {
    write("base.yaml", good_graph);
    const Graph graph = load_text(
        "extends: base.yaml\nseed: 8\ncommon: {field: other.yaml}\n"
        "processes:\n  - {name: camera, parameters: {frames_per_second: 5}}\n"
        "  - {name: detection, executable: other_finder}\n  - {name: extra, executable: tap}\n");
    EXPECT_EQ(graph.name, "graph");
    EXPECT_EQ(graph.seed, 8U);
    ASSERT_EQ(graph.processes.size(), 4U);
    EXPECT_EQ(graph.processes[0].executable, "source");
    const Configuration camera = graph.processes[0].configuration();
    EXPECT_EQ(camera.text("frames_per_second"), "5");
    EXPECT_EQ(camera.text("walk.speed"), "0.1");
    EXPECT_EQ(camera.text("field"), "other.yaml");
    EXPECT_EQ(graph.processes[1].executable, "other_finder");
    EXPECT_EQ(graph.processes[3].name, "extra");
}

TEST_F(GraphFileTest, InheritedCommonValuesNeedNotBeOfUse) {
    write("base.yaml", good_graph);
    const std::string processes =
        "processes: [{name: camera, enabled: false}, {name: localisation, enabled: false}]\n";
    const Graph graph = load_text("extends: base.yaml\nexternal: [IMAGE]\n" + processes);
    EXPECT_EQ(graph.processes.size(), 1U);
    EXPECT_THAT(error_of("extends: base.yaml\nexternal: [IMAGE]\ncommon: {field: f.yaml}\n" + processes),
                HasSubstr("graph.yaml:3: common: no process has a parameter 'field'"));
}

TEST_F(GraphFileTest, AnotherExecutableKeepsNoParametersOfTheFormerOne) {
    write("base.yaml", good_graph);
    const Graph graph = load_text("extends: base.yaml\nprocesses: [{name: camera, executable: source}]\n");
    EXPECT_EQ(graph.processes[0].settings.size(), 3U);
    write("base.yaml", with("executable: finder", "executable: finder\n    parameters: {threshold: 5}"));
    const Graph swapped =
        load_text("extends: base.yaml\nprocesses: [{name: detection, executable: other_finder}]\n");
    EXPECT_TRUE(swapped.find("detection")->settings.empty());
}

TEST_F(GraphFileTest, SettingsOfTheCommandLineHoldOverTheFile) {
    GraphOptions options;
    options.settings = {"camera.frames_per_second=60", "camera.walk.speed=0.3"};
    const Configuration camera = load_text(good_graph, options).find("camera")->configuration();
    EXPECT_EQ(camera.text("frames_per_second"), "60");
    EXPECT_EQ(camera.text("walk.speed"), "0.3");
}

TEST_F(GraphFileTest, TapIsChosenOnTheCommandLine) {
    GraphOptions options;
    options.tap = "raw";
    const Graph added = load_text(good_graph, options);
    ASSERT_NE(added.find("tap"), nullptr);
    EXPECT_EQ(added.find("tap")->configuration().text("every"), "1");
    const std::string with_tap =
        std::string(good_graph) + "  - {name: pictures, executable: tap, parameters: {every: 4}}\n";
    options.tap = "jpeg";
    const Graph changed = load_text(with_tap, options);
    EXPECT_EQ(changed.processes.size(), 4U);
    EXPECT_EQ(changed.find("pictures")->configuration().text("encoding"), "jpeg");
    EXPECT_EQ(changed.find("pictures")->configuration().text("every"), "4");
    options.tap = "off";
    EXPECT_EQ(load_text(with_tap, options).processes.size(), 3U);
}

struct Mistake {
    const char* name;
    std::string old_text;
    std::string new_text;
    std::vector<std::string> said;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.name;
}

class GraphMistake : public GraphFileTest, public testing::WithParamInterface<Mistake> {};

TEST_P(GraphMistake, IsSaidWithPlaceAndWhatWouldBeValid) {
    const Mistake& mistake = GetParam();
    const std::string error = error_of(with(mistake.old_text, mistake.new_text));
    for (const auto& part : mistake.said) EXPECT_THAT(error, HasSubstr(part));
}

const std::string detection = "  - name: detection\n    executable: finder\n";

INSTANTIATE_TEST_SUITE_P(
    EachKeyInTurn, GraphMistake,
    testing::Values(
        Mistake{"UnknownKey",
                "seed: 7",
                "sed: 7",
                {"graph.yaml:1: unknown key 'sed'", "did you mean 'seed'", "processes"}},
        Mistake{"KeyTwice", "seed: 7", "seed: 7\nseed: 8", {"graph.yaml:2: key 'seed' given twice"}},
        Mistake{"NotYaml", "seed: 7", "seed: [7", {"graph.yaml:", "not YAML"}},
        Mistake{"SeedText",
                "seed: 7",
                "seed: seven",
                {"graph.yaml:1: seed: 'seven' is not a whole number of at least 0"}},
        Mistake{"SeedNegative", "seed: 7", "seed: -7", {"graph.yaml:1: seed: '-7' is not"}},
        Mistake{"SeedList",
                "seed: 7",
                "seed: [7]",
                {"graph.yaml:1: seed: expected a whole number", "not a list"}},
        Mistake{"NameList", "seed: 7", "name: [a]", {"graph.yaml:1: name: expected a name, not a list"}},
        Mistake{
            "NameEmpty", "seed: 7", "name: ''", {"graph.yaml:1: name: expected a name, not an empty text"}},
        Mistake{"UrlNone",
                "udpm://239.255.76.67:7667?ttl=0",
                "239.255.76.67",
                {"graph.yaml:2: lcm_url:", "valid: udpm://"}},
        Mistake{"UrlProvider", "udpm://239", "upmd://239", {"graph.yaml:2: lcm_url:", "no provider 'upmd'"}},
        Mistake{"UrlUnicast",
                "udpm://239.255.76.67",
                "udpm://192.168.0.1",
                {"graph.yaml:2:", "no multicast group"}},
        Mistake{"UrlPort", ":7667", ":766700", {"graph.yaml:2:", "port is not a number in 1…65535"}},
        Mistake{
            "UrlOption", "ttl=0", "tll=0", {"graph.yaml:2:", "unknown option 'tll'", "did you mean 'ttl'"}},
        Mistake{"UrlTtl", "ttl=0", "ttl=300", {"graph.yaml:2:", "ttl is not a number in 0…255"}},
        Mistake{"UrlMemory",
                "udpm://239.255.76.67:7667?ttl=0",
                "memq://",
                {"graph.yaml:2:", "between processes"}},
        Mistake{"CommonText",
                "common:\n  field: fields/small.yaml",
                "common: field",
                {"graph.yaml:3: common: expected 'key: value'"}},
        Mistake{"CommonUnknown",
                "  field: fields/small.yaml",
                "  feild: fields/small.yaml",
                {"graph.yaml:4: common: no process has a parameter 'feild'", "did you mean 'field'"}},
        Mistake{"ExternalText",
                "seed: 7",
                "external: ODOMETRY",
                {"graph.yaml:1: external: expected a list of channels"}},
        Mistake{"ExternalName",
                "seed: 7",
                "external: ['A B']",
                {"graph.yaml:1: external: 'A B' is not the name of a channel"}},
        Mistake{"ExternalUnread",
                "seed: 7",
                "external: [ODOMTRY]",
                {"graph.yaml:1: external: no process subscribes ODOMTRY", "did you mean 'ODOMETRY'"}},
        Mistake{"ExternalInside",
                "seed: 7",
                "external: [IMAGE]",
                {"graph.yaml:6: camera: publishes IMAGE", "'external'"}},
        Mistake{"ExtendsMissing",
                "seed: 7",
                "extends: none.yaml",
                {"graph.yaml:1: extends: none.yaml does not exist"}},
        Mistake{
            "ExtendsItself", "seed: 7", "extends: graph.yaml", {"graph.yaml:1: extends: goes in a circle"}},
        Mistake{"ExtendsList",
                "seed: 7",
                "extends: [a]",
                {"graph.yaml:1: extends: expected the name of a graph file"}},
        Mistake{"ProcessesText", "processes:", "processes: none\nname:", {"graph.yaml:", "expected"}},
        Mistake{"ProcessText",
                detection,
                "  - detection\n",
                {"graph.yaml:9: an entry of processes: expected 'key: value'"}},
        Mistake{"ProcessUnknownKey",
                "    executable: finder",
                "    executable: finder\n    argumets: []",
                {"graph.yaml:11: unknown key 'argumets'", "did you mean 'arguments'"}},
        Mistake{"ProcessNoName",
                detection,
                "  - executable: finder\n",
                {"graph.yaml:9: an entry of processes has no 'name'"}},
        Mistake{
            "ProcessNameTaken", "name: detection", "name: camera", {"graph.yaml:9: name: 'camera' is taken"}},
        Mistake{"ProcessNameDotted",
                "name: detection",
                "name: de.tection",
                {"graph.yaml:9: name: 'de.tection' is not a name"}},
        Mistake{"ProcessNoExecutable",
                detection,
                "  - name: detection\n",
                {"graph.yaml:9: detection: has no 'executable'"}},
        Mistake{"ExecutableUnknown",
                "executable: finder",
                "executable: findre",
                {"graph.yaml:10: detection: executable: no program 'findre'", "looked in", "on PATH"}},
        Mistake{"ExecutablePath",
                "executable: finder",
                "executable: ./findre",
                {"graph.yaml:10: detection: executable: findre does not exist"}},
        Mistake{"ExecutableNoProgram",
                "executable: finder",
                "executable: ./graph.yaml",
                {"graph.yaml:10: detection: executable: graph.yaml is not a program that may be run"}},
        Mistake{"ExecutableSilent",
                "executable: finder",
                "executable: /bin/false",
                {"graph.yaml:10: detection: executable: asked '/bin/false --describe': exit code 1",
                 "'subscribes'"}},
        Mistake{"ExecutableNonsense",
                "executable: finder",
                "executable: /bin/echo",
                {"graph.yaml:10: detection: executable: asked", "not a description"}},
        Mistake{"ConfigMissing",
                "    executable: finder",
                "    executable: finder\n    config: none.yaml",
                {"graph.yaml:11: detection: config: none.yaml does not exist"}},
        Mistake{"ConfigList",
                "    executable: finder",
                "    executable: finder\n    config: [a]",
                {"graph.yaml:11: detection: config: expected the name of a file"}},
        Mistake{"ParametersText",
                "    executable: finder",
                "    executable: finder\n    parameters: much",
                {"graph.yaml:11: detection: parameters: expected 'key: value'"}},
        Mistake{"ParameterUnknown",
                "frames_per_second: 15",
                "frames_per_secnd: 15",
                {"graph.yaml:8: camera: unknown parameter 'frames_per_secnd' of source",
                 "did you mean 'frames_per_second'"}},
        Mistake{"ParameterValue",
                "frames_per_second: 15",
                "frames_per_second: fast",
                {"graph.yaml:8: camera: frames_per_second: 'fast' is not a number"}},
        Mistake{"CommonValue",
                "field: fields/small.yaml",
                "field: [a, b]",
                {"graph.yaml:4: camera: field: '[a, b]' is not the name of a file"}},
        Mistake{"ParameterUnknownNested",
                "walk: {speed",
                "walk: {sped",
                {"graph.yaml:8: camera: unknown parameter 'walk.sped'"}},
        Mistake{"ChannelsList",
                "    executable: finder",
                "    executable: finder\n    channels: [A]",
                {"graph.yaml:11: detection: channels: expected 'key: value'"}},
        Mistake{"ChannelUnused",
                "    executable: finder",
                "    executable: finder\n    channels: {POST: B}",
                {"graph.yaml:11: detection: channels: finder does not use a channel 'POST'",
                 "did you mean 'POSTS'"}},
        Mistake{"ChannelName",
                "    executable: finder",
                "    executable: finder\n    channels: {POSTS: 'a b'}",
                {"graph.yaml:11: detection: channels.POSTS: 'a b' is not the name of a channel"}},
        Mistake{"ChannelNameLong",
                "    executable: finder",
                "    executable: finder\n    channels: {POSTS: " + std::string(64, 'A') + "}",
                {"graph.yaml:11:", "longer than the 63 characters"}},
        Mistake{"ArgumentsText",
                "    executable: finder",
                "    executable: finder\n    arguments: -v",
                {"graph.yaml:11: detection: arguments: expected a list of texts"}},
        Mistake{"EnabledText",
                "    executable: finder",
                "    executable: finder\n    enabled: perhaps",
                {"graph.yaml:11: detection: enabled: expected true or false, not 'perhaps'"}},
        Mistake{"SubscribesText",
                "    executable: finder",
                "    executable: /bin/true\n    subscribes: IMAGE",
                {"graph.yaml:11: detection: subscribes: expected a list of channels"}},
        Mistake{"PublishesNoChannel",
                "    executable: finder",
                "    executable: /bin/true\n    publishes: [{type: posts_t}]",
                {"graph.yaml:11: detection: publishes: an entry has no 'channel'"}},
        Mistake{"NobodyPublishes",
                detection,
                "",
                {"graph.yaml:9: localisation: subscribes POSTS (posts_t), which nobody publishes"}},
        Mistake{"TwoPublish",
                detection,
                detection + "  - {name: second, executable: other_finder}\n",
                {"graph.yaml:11: second: publishes POSTS, which detection (graph.yaml:9) publishes too",
                 "'channels'"}},
        Mistake{"TypesDiffer",
                "executable: locator",
                "executable: odd\n  - {name: l, executable: locator}",
                {"graph.yaml:11: localisation: subscribes POSTS as pose_t, but detection (graph.yaml:9) "
                 "publishes posts_t"}}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(GraphValue, IsJudgedByTheProgramsRule) {
    EXPECT_TRUE(value_is_valid("3.5", "a number in 0…5"));
    EXPECT_FALSE(value_is_valid("5.5", "a number in 0…5"));
    EXPECT_FALSE(value_is_valid("fast", "a number"));
    EXPECT_FALSE(value_is_valid(".nan", "a number"));
    EXPECT_FALSE(value_is_valid("[1]", "a number"));
    EXPECT_TRUE(value_is_valid("-1e3", "a number of at most 0"));
    EXPECT_FALSE(value_is_valid("-1e3", "a number of at least -10"));
    EXPECT_TRUE(value_is_valid("7", "a whole number in 1…100000"));
    EXPECT_FALSE(value_is_valid("7.5", "a whole number in 1…100000"));
    EXPECT_TRUE(value_is_valid("[1, 2.5]", "a list of numbers in 0…3"));
    EXPECT_FALSE(value_is_valid("[1, 4]", "a list of numbers in 0…3"));
    EXPECT_FALSE(value_is_valid("1", "a list of numbers"));
    EXPECT_TRUE(value_is_valid("true", "true or false"));
    EXPECT_FALSE(value_is_valid("perhaps", "true or false"));
    EXPECT_TRUE(value_is_valid("jpeg", "one of: raw, jpeg"));
    EXPECT_FALSE(value_is_valid("jpe", "one of: raw, jpeg"));
    EXPECT_TRUE(value_is_valid("\"\"", "the name of a file"));
    EXPECT_FALSE(value_is_valid("[a]", "a text"));
    EXPECT_FALSE(value_is_valid("[1", "a text"));
    EXPECT_TRUE(value_is_valid("whatever", "a colour somebody else's program knows"));
}

TEST(GraphValue, DefaultsOfOurOwnParametersHold) {
    ParameterLister lister;
    double number = 0.25;
    int whole = 3;
    bool flag = true;
    std::string word = "raw";
    std::vector<double> list = {1, 2};
    lister("a", number, above(0), "m", "");
    lister("b", whole, Range{1, 5}, "1", "");
    lister("c", flag, "");
    lister("d", word, Choice{"raw", "jpeg"}, "");
    lister("e", list, at_least(0), "m", "");
    lister("f", word, File{}, "");
    lister("g", word, Text{}, "");
    for (const auto& parameter : lister.parameters) {
        EXPECT_TRUE(value_is_valid(parameter.value, parameter.valid))
            << parameter.value << " is not " << parameter.valid;
        const std::string wrong = parameter.key == "f" || parameter.key == "g" ? "[]" : "-7";
        EXPECT_FALSE(value_is_valid(wrong, parameter.valid)) << wrong << " is " << parameter.valid;
    }
}

TEST_F(GraphFileTest, CirclesOfThreeFilesAreFound) {
    write("a.yaml", "extends: b.yaml\n");
    write("b.yaml", "extends: graph.yaml\n");
    EXPECT_THAT(error_of("extends: a.yaml\n"),
                HasSubstr("b.yaml:1: extends: goes in a circle: graph.yaml → a.yaml → b.yaml"));
}

TEST_F(GraphFileTest, EmptyFilesAndGraphsWithoutProcessesAreErrors) {
    EXPECT_THAT(error_of(""), HasSubstr("graph.yaml: is empty"));
    EXPECT_THAT(error_of("seed: 3\n"), HasSubstr("processes: there is none"));
    EXPECT_THAT(error_of("processes: []\n"), HasSubstr("processes: there is none"));
    EXPECT_THAT(error_of("- a\n"), HasSubstr("graph.yaml:1: the graph: expected 'key: value'"));
}

TEST_F(GraphFileTest, MistakesOnTheCommandLineAreSaid) {
    EXPECT_THAT(error_of(good_graph, {{"camera=3"}, "", {}}),
                HasSubstr("--set: 'camera=3' is not of the form PROCESS.KEY=VALUE"));
    EXPECT_THAT(error_of(good_graph, {{"camra.walk.speed=3"}, "", {}}), HasSubstr("did you mean 'camera'"));
    EXPECT_THAT(error_of(good_graph, {{"camera.walk.sped=3"}, "", {}}),
                HasSubstr("--set: camera: unknown parameter 'walk.sped'"));
    EXPECT_THAT(error_of(good_graph, {{}, "png", {}}), HasSubstr("--tap: 'png' is not one of"));
}

TEST_F(GraphFileTest, GraphsAreFoundByName) {
    try {
        find_graph("ransak");
        FAIL() << "a graph of that name";
    } catch (const ConfigurationError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no graph 'ransak'"));
        EXPECT_THAT(error.what(), HasSubstr("did you mean 'ransac'"));
    }
    EXPECT_EQ(find_graph("ransac").filename(), "ransac.yaml");
}

TEST_F(GraphFileTest, UrlOfTheCommandLineHoldsOverGraphOverVariable) {
    Graph graph;
    ::setenv("LCM_DEFAULT_URL", "udpm://239.255.76.67:7001?ttl=0", 1);
    EXPECT_EQ(lcm_url_of(graph), "udpm://239.255.76.67:7001?ttl=0");
    graph.lcm_url = "udpm://239.255.76.67:7002?ttl=0";
    EXPECT_EQ(lcm_url_of(graph), graph.lcm_url);
    EXPECT_EQ(lcm_url_of(graph, "udpm://239.255.76.67:7003"), "udpm://239.255.76.67:7003");
    ::unsetenv("LCM_DEFAULT_URL");
    EXPECT_EQ(lcm_url_of(Graph{}), default_lcm_url);
    EXPECT_THROW(lcm_url_of(graph, "nonsense"), ConfigurationError);
}

TEST_F(GraphFileTest, TableAndPictureNameEveryProcessAndChannel) {
    const Graph graph = load_text(good_graph);
    for (const std::string& text : {graph_as_table(graph), graph_as_dot(graph)}) {
        for (const char* word : {"camera", "source", "detection", "localisation", "IMAGE", "POSTS", "POSE"}) {
            EXPECT_THAT(text, HasSubstr(word));
        }
    }
    EXPECT_THAT(graph_as_dot(graph), HasSubstr(R"("detection" -> "localisation" [label="POSTS"])"));
    EXPECT_THAT(graph_as_table(graph), HasSubstr("(ODOMETRY)"));
}

TEST(ProgramDescriptionTest, IsReadAsModulesPrintIt) {
    const ProgramDescription read = parse_description(
        "executable: finder\nsummary: finds\nsubscribes:\n  - channel: IMAGE\n    type: image_t\n    "
        "meaning: m\n    optional: true\n"
        "publishes:\n  []\nparameters:\n  - key: walk.speed\n    value: \"0.2\"\n    valid: a number\n    "
        "unit: m/s\n    meaning: how fast\n");
    EXPECT_EQ(read.info.executable, "finder");
    ASSERT_EQ(read.info.subscribes.size(), 1U);
    EXPECT_TRUE(read.info.subscribes[0].optional);
    EXPECT_TRUE(read.info.publishes.empty());
    ASSERT_EQ(read.parameters.size(), 1U);
    EXPECT_EQ(read.parameters[0].unit, "m/s");
    EXPECT_THROW(parse_description("usage: finder FILE"), std::runtime_error);
    EXPECT_THROW(parse_description("{"), std::runtime_error);
}

/// The lines of a file without those that only comment.
std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::vector<std::string> lines;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(ShippedGraphs, SwappingTheDetectorIsOneLine) {
    const std::filesystem::path graphs = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config/graphs";
    const auto ransac = lines_of(graphs / "ransac.yaml");
    const auto histogram = lines_of(graphs / "histogram.yaml");
    ASSERT_FALSE(ransac.empty());
    ASSERT_EQ(ransac.size(), histogram.size());
    std::vector<std::string> different;
    for (std::size_t i = 0; i < ransac.size(); ++i) {
        if (ransac[i] != histogram[i]) different.push_back(histogram[i]);
    }
    EXPECT_THAT(different, ElementsAre(HasSubstr("executable: detection_histogram")));
}

}  // namespace
}  // namespace goalmouth
