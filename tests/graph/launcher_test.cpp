// The launcher with processes that misbehave.

#include "core/process/launcher.h"

#include "core/process/guardian.h"
#include "tests/support/data.h"
#include "tests/support/processes.h"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::eventually;
using testing::HasSubstr;
using Kind = LauncherEvent::Kind;

constexpr const char* url = "udpm://239.255.76.67:7667?ttl=0";

class LauncherTest : public testing::Test {
  protected:
    /// A graph of helpers, one for each behaviour: "p0", "p1", …
    Graph graph_of(const std::vector<std::string>& behaviours) const {
        const auto file = folder_.path() / "graph.yaml";
        std::ofstream out(file);
        out << "processes:\n";
        int number = 0;
        for (const auto& behaviour : behaviours) {
            out << "  - name: p" << number++ << "\n    executable: graph_helper\n    parameters: {"
                << behaviour << "}\n";
        }
        out.close();
        return load_graph(file.string());
    }

    static LauncherOptions quick() {
        LauncherOptions options;
        options.lcm_url = url;
        options.first_backoff = 0.05;
        options.longest_backoff = 0.4;
        options.grace = 1.0;
        return options;
    }

    /// Polls until an event fits. All events so far stay in `events`.
    bool poll_until(Launcher& launcher, const std::function<bool(const LauncherEvent&)>& fits) {
        return eventually([&] {
            bool found = false;
            for (auto& event : launcher.poll(std::chrono::milliseconds(20))) {
                found = found || fits(event);
                events.push_back(std::move(event));
            }
            return found;
        });
    }
    bool poll_until(Launcher& launcher, Kind kind, const std::string& text = {}) {
        return poll_until(launcher, [&](const LauncherEvent& event) {
            return event.kind == kind && event.text.find(text) != std::string::npos;
        });
    }

    /// The number behind `word` in the output so far.
    pid_t number_after(const std::string& word) const {
        for (const auto& event : events) {
            if (event.process == 0 && event.text.starts_with(word))
                return std::stoi(event.text.substr(word.size()));
        }
        return 0;
    }

    std::vector<LauncherEvent> events;
    test::TemporaryFolder folder_;
};

TEST_F(LauncherTest, StartsProcessesAndHearsTheirStatus) {
    Launcher launcher(graph_of({"behaviour: well", "behaviour: well"}), quick());
    launcher.start();
    EXPECT_TRUE(eventually([&] {
        launcher.poll(std::chrono::milliseconds(20));
        const auto all = launcher.processes();
        return all[0].status && all[1].status && all[1].status->state == status_t::RUNNING;
    }));
    const auto processes = launcher.processes();
    EXPECT_EQ(processes[1].name, "p1");
    EXPECT_EQ(processes[1].state, ProcessState::running);
    EXPECT_EQ(processes[1].status->pid, processes[1].pid);
    EXPECT_EQ(::getpgid(processes[1].pid), processes[1].pid);
    EXPECT_TRUE(launcher.all_alive());
    launcher.stop();
    EXPECT_TRUE(launcher.all_ended());
    for (const auto& process : processes) EXPECT_FALSE(test::process_lives(process.pid));
    EXPECT_EQ(launcher.processes()[0].last_end, "exit code 0");
}

TEST_F(LauncherTest, RestartsWhatCrashesAfterGrowingPauses) {
    Launcher launcher(graph_of({"behaviour: aborts", "behaviour: well"}), quick());
    launcher.start();
    ASSERT_TRUE(eventually([&] {
        for (auto& event : launcher.poll(std::chrono::milliseconds(20))) events.push_back(std::move(event));
        return launcher.processes()[0].restarts >= 4;
    }));
    std::vector<std::string> deaths;
    for (const auto& event : events) {
        if (event.kind == Kind::died) deaths.push_back(event.text);
        EXPECT_FALSE(event.kind == Kind::died && event.process == 1);
    }
    ASSERT_GE(deaths.size(), 4U);
    EXPECT_THAT(deaths[0], HasSubstr("killed by SIGABRT (6)"));
    EXPECT_THAT(deaths[1], HasSubstr("starts again in 0.1 s"));
    EXPECT_THAT(deaths[2], HasSubstr("starts again in 0.2 s"));
    EXPECT_THAT(deaths[3], HasSubstr("starts again in 0.4 s"));
    EXPECT_EQ(launcher.processes()[1].restarts, 0);
}

TEST_F(LauncherTest, WhoLivedLongStartsAgainAtOnce) {
    LauncherOptions options = quick();
    options.steady_after = 0.0;
    Launcher launcher(graph_of({"behaviour: exits_1"}), options);
    launcher.start();
    for (int death = 0; death < 4; ++death) {
        EXPECT_TRUE(poll_until(launcher, Kind::died, "exit code 1 after"));
        EXPECT_THAT(events.back().text,
                    testing::AnyOf(HasSubstr("again in 0.1 s"), HasSubstr("again in 0.0 s")));
    }
}

TEST_F(LauncherTest, KilledProcessesComeBack) {
    Launcher launcher(graph_of({"behaviour: well"}), quick());
    launcher.start();
    ASSERT_TRUE(poll_until(launcher, Kind::output, "file"));
    const pid_t first = launcher.processes()[0].pid;
    ::kill(first, SIGKILL);
    EXPECT_TRUE(poll_until(launcher, Kind::died, "killed by SIGKILL (9)"));
    EXPECT_TRUE(poll_until(launcher, Kind::output, "file"));
    EXPECT_NE(launcher.processes()[0].pid, first);
    EXPECT_EQ(launcher.processes()[0].restarts, 1);
}

TEST_F(LauncherTest, ConfigurationErrorsAreNotTriedAgain) {
    Launcher launcher(graph_of({"behaviour: misconfigured"}), quick());
    launcher.start();
    ASSERT_TRUE(poll_until(launcher, Kind::failed, "exit code 2"));
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const LauncherEvent& event) {
        return event.kind == Kind::output && event.text.find("helper.yaml:3: behaviour") != std::string::npos;
    }));
    EXPECT_EQ(launcher.processes()[0].exit_code, 2);
    EXPECT_TRUE(launcher.all_ended());
    EXPECT_FALSE(launcher.all_alive());
}

TEST_F(LauncherTest, FinishedSourcesAreNotStartedAgain) {
    Launcher launcher(graph_of({"behaviour: finishes"}), quick());
    launcher.start();
    EXPECT_TRUE(poll_until(launcher, Kind::finished));
    EXPECT_TRUE(launcher.all_ended());
    EXPECT_TRUE(launcher.all_alive());
}

TEST_F(LauncherTest, WhatCannotRunSaysWhy) {
    Graph graph = graph_of({"behaviour: well"});
    const auto script = folder_.path() / "script";
    std::ofstream(script) << "#!/no/such/interpreter\n";
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    graph.processes[0].program = script;
    Launcher launcher(graph, quick());
    launcher.start();
    EXPECT_TRUE(poll_until(launcher, Kind::failed, "script: No such file or directory"));
}

TEST_F(LauncherTest, WhoIgnoresSigtermIsKilledAfterTheGraceTime) {
    Launcher launcher(graph_of({"behaviour: stubborn"}), quick());
    launcher.start();
    ASSERT_TRUE(poll_until(launcher, Kind::output, "file"));
    const pid_t pid = launcher.processes()[0].pid;
    launcher.stop();
    EXPECT_FALSE(test::process_lives(pid));
    EXPECT_EQ(launcher.processes()[0].last_end, "killed by SIGKILL (9)");
}

TEST_F(LauncherTest, ASecondWishKillsAtOnce) {
    LauncherOptions options = quick();
    options.grace = 1000.0;
    Launcher launcher(graph_of({"behaviour: stubborn"}), options);
    launcher.start();
    ASSERT_TRUE(poll_until(launcher, Kind::output, "file"));
    launcher.stop([] { return true; });
    EXPECT_TRUE(launcher.all_ended());
}

TEST_F(LauncherTest, ChildrenOfProcessesGoToo) {
    Launcher launcher(graph_of({"behaviour: has_child", "behaviour: abandons_child, after: 0.5"}), quick());
    launcher.start();
    pid_t abandoned = 0;
    ASSERT_TRUE(poll_until(launcher, [&](const LauncherEvent& event) {
        if (event.process == 1 && event.text.starts_with("child "))
            abandoned = std::stoi(event.text.substr(6));
        return abandoned != 0;
    }));
    EXPECT_TRUE(poll_until(launcher, Kind::died));
    EXPECT_TRUE(eventually([&] { return !test::process_lives(abandoned); }));
    const pid_t child = number_after("child ");
    ASSERT_TRUE(test::process_lives(child));
    launcher.stop();
    EXPECT_FALSE(test::process_lives(child));
}

TEST_F(LauncherTest, LinesComeWhole) {
    Launcher launcher(graph_of({"behaviour: talks", "behaviour: talks"}), quick());
    launcher.start();
    int lines = 0;
    EXPECT_TRUE(poll_until(launcher, [&](const LauncherEvent& event) {
        lines += event.kind == Kind::output && event.text == "this is one whole line" ? 1 : 0;
        EXPECT_FALSE(event.kind == Kind::output && event.text.starts_with("this") &&
                     event.text != "this is one whole line");
        return lines >= 100;
    }));
}

TEST_F(LauncherTest, FileNamesReachTheProcessWhole) {
    Launcher launcher(graph_of({"file: a/b.yaml"}), quick());
    launcher.start();
    EXPECT_TRUE(poll_until(launcher, Kind::output, "file " + (folder_.path() / "a/b.yaml").string()));
}

TEST_F(LauncherTest, AKilledGuardianIsReplaced) {
    Guardian guardian(1.0, {});
    const pid_t first = guardian.pid();
    EXPECT_FALSE(guardian.keep_alive());
    ::kill(first, SIGKILL);
    EXPECT_TRUE(eventually([&] { return guardian.keep_alive(); }));
    EXPECT_NE(guardian.pid(), first);
    EXPECT_TRUE(test::process_lives(guardian.pid()));
}

/// A process that runs a launcher, to be killed. Tells through a pipe when everything runs.
class LaunchingProcess {
  public:
    LaunchingProcess(const Graph& graph, const LauncherOptions& options) {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        pid_ = ::fork();
        if (pid_ == 0) run(graph, options, ends[1]);
        ::close(ends[1]);
        if (::read(ends[0], &process_, sizeof process_) != sizeof process_) process_ = 0;
        ::close(ends[0]);
    }
    ~LaunchingProcess() { kill(); }
    LaunchingProcess(const LaunchingProcess&) = delete;
    LaunchingProcess& operator=(const LaunchingProcess&) = delete;

    void kill() {
        if (pid_ == 0) return;
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
        pid_ = 0;
    }
    pid_t process() const { return process_; }

  private:
    [[noreturn]] static void run(const Graph& graph, const LauncherOptions& options, int told) {
        Launcher launcher(graph, options);
        launcher.start();
        for (;;) {
            for (const auto& event : launcher.poll(std::chrono::milliseconds(100))) {
                const pid_t process = launcher.processes()[0].pid;
                const bool begun = event.kind == Kind::output && event.text.starts_with("ready");
                if (begun && ::write(told, &process, sizeof process) < 0) ::_exit(1);
            }
        }
    }

    pid_t pid_ = 0;
    pid_t process_ = 0;
};

TEST_F(LauncherTest, NothingIsLeftWhenTheLauncherIsKilled) {
    for (const char* behaviour : {"behaviour: well", "behaviour: stubborn", "behaviour: has_child"}) {
        LaunchingProcess launching(graph_of({behaviour}), quick());
        const pid_t group = launching.process();
        ASSERT_TRUE(living_groups().contains(group)) << behaviour;
        launching.kill();
        EXPECT_TRUE(eventually([&] { return !living_groups().contains(group); })) << behaviour;
    }
}

}  // namespace
}  // namespace goalmouth
