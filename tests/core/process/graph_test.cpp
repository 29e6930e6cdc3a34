#include "tests/core/process/graph_fixture.h"

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using testing::ElementsAre;
using testing::HasSubstr;

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

/// The lines of a file.
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
