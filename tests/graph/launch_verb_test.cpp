// `goalmouth launch` and its neighbours as a user types them.

#include "tests/support/data.h"
#include "tests/support/processes.h"

#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::eventually;
using test::marked_processes;
using test::Running;
using testing::HasSubstr;
using testing::IsEmpty;

class Verb : public testing::Test {
  protected:
    std::unique_ptr<Running> run(const std::vector<std::string>& words) const {
        std::vector<std::string> command = {test::program("goalmouth").string()};
        command.insert(command.end(), words.begin(), words.end());
        return std::make_unique<Running>(command, mark_);
    }

    /// A graph of one helper.
    std::string helper_graph(const std::string& parameters) const {
        const auto file = folder_.path() / "helper.yaml";
        std::ofstream(file) << "processes:\n  - {name: helper, executable: graph_helper, parameters: {"
                            << parameters << "}}\n";
        return file.string();
    }

    std::set<pid_t> processes() const {
        const auto found = marked_processes(mark_);
        return {found.begin(), found.end()};
    }

    std::string mark_ = test::new_mark();
    test::TemporaryFolder folder_;
};

TEST_F(Verb, CtrlCEndsEverythingInGoodOrder) {
    auto launch = run({"launch", "ransac", "--set", "camera.frames_per_second=10"});
    ASSERT_TRUE(eventually([&] { return launch->wrote("6 of 6 alive"); })) << launch->output();
    const auto before = processes();
    EXPECT_GE(before.size(), 8U);  // the launcher, its guardian, and six
    EXPECT_TRUE(eventually([&] { return test::rings_of(before).size() == 1; })) << launch->output();
    launch->signal(SIGINT);
    EXPECT_EQ(launch->wait(), 0) << launch->output();
    EXPECT_TRUE(launch->wrote("segmentation | stopped: exit code 0")) << launch->output();
    EXPECT_THAT(processes(), IsEmpty());
    EXPECT_THAT(test::rings_of(before), IsEmpty());
}

TEST_F(Verb, NothingIsLeftWhenItIsKilled) {
    auto launch = run({"launch", "ransac", "--set", "camera.frames_per_second=10"});
    ASSERT_TRUE(eventually([&] { return launch->wrote("6 of 6 alive"); })) << launch->output();
    const auto before = processes();
    launch->signal(SIGKILL);
    EXPECT_EQ(launch->wait(), 128 + SIGKILL);
    EXPECT_TRUE(eventually([&] { return processes().empty(); }));
    EXPECT_THAT(test::rings_of(before), IsEmpty());
}

TEST_F(Verb, LaunchEndsAfterItsTime) {
    auto launch = run({"launch", helper_graph("behaviour: well"), "--seconds", "1"});
    EXPECT_EQ(launch->wait(), 0) << launch->output();
    EXPECT_TRUE(launch->wrote("helper    | file")) << launch->output();
    EXPECT_THAT(processes(), IsEmpty());
}

TEST_F(Verb, AProcessThatCannotBeKeptAliveIsExitCode1) {
    auto launch = run({"launch", helper_graph("behaviour: aborts"), "--seconds", "2"});
    EXPECT_EQ(launch->wait(), 1) << launch->output();
    EXPECT_TRUE(launch->wrote("killed by SIGABRT (6)")) << launch->output();
}

TEST_F(Verb, AWrongConfigurationOfAProcessIsExitCode2) {
    auto launch = run({"launch", helper_graph("behaviour: misconfigured")});
    EXPECT_EQ(launch->wait(), 2) << launch->output();
    EXPECT_TRUE(launch->wrote("helper.yaml:3: behaviour: is not valid")) << launch->output();
    EXPECT_TRUE(launch->wrote("its configuration is wrong")) << launch->output();
}

TEST_F(Verb, AWrongValueOfAModuleIsExitCode2) {
    auto launch = run({"launch", "ransac", "--set", "camera.frames_per_second=fast"});
    EXPECT_EQ(launch->wait(), 2) << launch->output();
    EXPECT_TRUE(launch->wrote("frames_per_second: 'fast' is not a number")) << launch->output();
    EXPECT_THAT(processes(), IsEmpty());
}

TEST_F(Verb, AnEvaluationOfWhatIsNotThereIsExitCode2) {
    const std::string json = (folder_.path() / "out.json").string();
    auto scene = run({"evaluate", "paper", "--scene", "flatt", "--json", json});
    EXPECT_EQ(scene->wait(), 2);
    EXPECT_TRUE(scene->wrote("did you mean 'flat'")) << scene->output();
    auto frames = run({"evaluate", "paper", "--frames-per-cell", "0", "--json", json});
    EXPECT_EQ(frames->wait(), 2);
    EXPECT_TRUE(frames->wrote("--frames-per-cell")) << frames->output();
    auto pictures = run({"evaluate", "images", (folder_.path() / "nowhere").string(), "--json", json});
    EXPECT_EQ(pictures->wait(), 2);
    EXPECT_TRUE(pictures->wrote("nowhere: no such folder")) << pictures->output();
    EXPECT_FALSE(std::filesystem::exists(json));
}

TEST_F(Verb, AWrongGraphIsExitCode2) {
    auto unknown = run({"launch", "ransak"});
    EXPECT_EQ(unknown->wait(), 2);
    EXPECT_TRUE(unknown->wrote("did you mean 'ransac'")) << unknown->output();
    auto parameter = run({"graph", helper_graph("behavior: well")});
    EXPECT_EQ(parameter->wait(), 2);
    EXPECT_TRUE(parameter->wrote(
        "helper.yaml:2: helper: unknown parameter 'behavior' of graph_helper; did you mean 'behaviour'"))
        << parameter->output();
    auto verb = run({"lanch", "ransac"});
    EXPECT_EQ(verb->wait(), 2);
    EXPECT_TRUE(verb->wrote("unknown verb 'lanch'; did you mean 'launch'?")) << verb->output();
    auto misspelt = run({"graph", "--dto"});
    EXPECT_EQ(misspelt->wait(), 2);
    EXPECT_TRUE(misspelt->wrote("unknown option '--dto'; did you mean '--dot'?")) << misspelt->output();
    auto option = run({"launch", "ransac", "--tap", "png"});
    EXPECT_EQ(option->wait(), 2) << option->output();
}

TEST_F(Verb, AFinishedGraphEndsWithExitCode0) {
    auto launch = run({"launch", helper_graph("behaviour: finishes")});
    EXPECT_EQ(launch->wait(), 0) << launch->output();
}

TEST_F(Verb, ASecondCtrlCDoesNotWait) {
    auto launch = run({"launch", helper_graph("behaviour: stubborn")});
    ASSERT_TRUE(eventually([&] { return launch->wrote("ready"); })) << launch->output();
    launch->signal(SIGINT);
    // Signals that come together count as one.
    EXPECT_TRUE(eventually([&] {
        launch->signal(SIGINT);
        return processes().empty();
    })) << launch->output();
    // One more may meet it on its way out, when nothing is left to be done.
    EXPECT_THAT(launch->wait(), testing::AnyOf(0, 128 + SIGINT));
}

TEST_F(Verb, AReaderThatGoesEndsTheGraph) {
    auto shell = std::make_unique<Running>(
        std::vector<std::string>{"/bin/sh", "-c",
                                 test::program("goalmouth").string() + " launch " +
                                     helper_graph("behaviour: talks") + " | head -n 3"},
        mark_);
    EXPECT_EQ(shell->wait(), 0) << shell->output();
    EXPECT_TRUE(eventually([&] { return processes().empty(); }));
}

TEST_F(Verb, EveryShippedGraphIsValid) {
    for (const auto& entry :
         std::filesystem::directory_iterator(test::shipped_graph("ransac").parent_path())) {
        if (entry.path().extension() != ".yaml") continue;
        auto graph = run({"graph", entry.path().string()});
        EXPECT_EQ(graph->wait(), 0) << entry.path() << '\n' << graph->output();
        EXPECT_TRUE(graph->wrote("localisation")) << graph->output();
    }
}

TEST_F(Verb, GraphIsDrawn) {
    auto dot = run({"graph", "ransac", "--dot"});
    EXPECT_EQ(dot->wait(), 0);
    EXPECT_TRUE(dot->wrote(R"("extraction" -> "detection" [label="CANDIDATES"])")) << dot->output();
    const auto picture = folder_.path() / "graph.svg";
    auto draw = run({"graph", "ransac", "-o", picture.string()});
    const int code = draw->wait();
    if (draw->wrote("is not installed")) GTEST_SKIP() << "skipped: graphviz is not installed";
    EXPECT_EQ(code, 0) << draw->output();
    std::ifstream file(picture);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(text, HasSubstr("<svg"));
    auto wrong = run({"graph", "ransac", "-o", "graph.bmp"});
    EXPECT_EQ(wrong->wait(), 2);
}

TEST_F(Verb, SpySaysWhatIsMissing) {
    ::unsetenv("DISPLAY");
    auto spy = run({"spy"});
    EXPECT_EQ(spy->wait(), 1);
    EXPECT_TRUE(spy->wrote("$DISPLAY is not set") || spy->wrote("apt install")) << spy->output();
}

/// What bash offers for a command line whose last word is incomplete.
class Completion : public Verb {
  protected:
    std::string offered(const std::vector<std::string>& words) const {
        std::string line;
        for (const auto& word : words) line += " '" + word + "'";
        const std::string script =
            "source <(" + test::program("goalmouth").string() + " completion bash); COMP_WORDS=(" + line +
            "); COMP_CWORD=" + std::to_string(words.size() - 1) + "; _goalmouth; echo \"${COMPREPLY[*]}\"";
        Running bash({"/bin/bash", "-c", script}, mark_);
        EXPECT_EQ(bash.wait(), 0) << bash.output();
        return bash.output();
    }
};

TEST_F(Completion, OffersVerbsOptionsAndValues) {
    EXPECT_THAT(offered({"goalmouth", "la"}), HasSubstr("launch"));
    EXPECT_THAT(offered({"goalmouth", "launch", "--sec"}), HasSubstr("--seconds"));
    EXPECT_EQ(offered({"goalmouth", "launch", "--tap", ""}), "raw jpeg off\n");
    EXPECT_EQ(offered({"goalmouth", "launch", "histo"}), "histogram\n");
    EXPECT_THAT(offered({"goalmouth", "completion", ""}), HasSubstr("bash zsh fish"));
    std::ofstream(folder_.path() / "picture.svg");
    EXPECT_EQ(offered({"goalmouth", "graph", "-o", (folder_.path() / "pic").string()}),
              (folder_.path() / "picture.svg").string() + "\n");
    EXPECT_EQ(offered({"goalmouth", "colours", "teach", (folder_.path() / "pic").string()}),
              (folder_.path() / "picture.svg").string() + "\n");
}

TEST_F(Completion, IsPrintedForEachShell) {
    for (const char* shell : {"zsh", "fish"}) {
        auto printed = run({"completion", shell});
        EXPECT_EQ(printed->wait(), 0);
        EXPECT_TRUE(printed->wrote("launch") && printed->wrote("lcm-url")) << shell;
    }
}

}  // namespace
}  // namespace goalmouth
