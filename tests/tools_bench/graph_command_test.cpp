// The graph's part through the command line: real processes in a network of their own.

#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/network.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::chrono::seconds patience{60};

/// A run of goalmouth_bench whose temporary files have a folder of their own.
class GraphCommand : public testing::Test {
  protected:
    void SetUp() override {
        GOALMOUTH_NEEDS_PRIVATE_NETWORK();
        fs::create_directory(temporary());
    }

    fs::path temporary() const { return folder_.path() / "temporary"; }
    fs::path json_file() const { return folder_.path() / "bench.json"; }
    fs::path errors() const { return folder_.path() / "err"; }

    pid_t start(const std::string& seconds) const {
        const pid_t child = ::fork();
        if (child != 0) return child;
        const int out = ::open((folder_.path() / "out").c_str(), O_WRONLY | O_CREAT, 0600);
        const int err = ::open(errors().c_str(), O_WRONLY | O_CREAT, 0600);
        ::dup2(out, STDOUT_FILENO);
        ::dup2(err, STDERR_FILENO);
        ::setenv("TMPDIR", temporary().c_str(), 1);
        const std::string program = GOALMOUTH_BINARY_DIR "/bin/goalmouth_bench";
        ::execl(program.c_str(), program.c_str(), "--only", "graph", "--size", "640x480", "--frames", "2",
                "--scene", "flat", "--seconds", seconds.c_str(), "--json", json_file().c_str(),
                static_cast<char*>(nullptr));
        ::_exit(127);
    }

    static int wait_for(pid_t child) {
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

    /// Files of the run's own that are still there.
    std::vector<std::string> leftovers() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(temporary()))
            names.push_back(entry.path().filename().string());
        return names;
    }

    /// The run's segmentation at work, not one that describes itself: a process but the benchmark itself with
    /// the run's folder for temporary files.
    std::optional<pid_t> module(pid_t bench) const {
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
            const std::string name = entry.path().filename().string();
            if (name.find_first_not_of("0123456789") != std::string::npos || name == std::to_string(bench))
                continue;
            std::ifstream file(entry.path() / "environ", std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(file), {}};
            if (text.find("TMPDIR=" + temporary().string()) == std::string::npos) continue;
            std::ifstream name_file(entry.path() / "comm");
            std::string program;
            if (!(name_file >> program) || program != "segmentation") continue;
            std::ifstream words(entry.path() / "cmdline", std::ios::binary);
            const std::string command{std::istreambuf_iterator<char>(words), {}};
            if (command.find("--describe") == std::string::npos) return std::stoi(name);
        }
        return std::nullopt;
    }

    std::optional<pid_t> wait_for_module(pid_t bench) const {
        const auto end = std::chrono::steady_clock::now() + patience;
        for (;;) {
            const auto found = module(bench);
            if (found || std::chrono::steady_clock::now() >= end) return found;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    test::TemporaryFolder folder_;
};

TEST_F(GraphCommand, MeasuresAndWritesTheThreeRows) {
    ASSERT_EQ(wait_for(start("2")), 0) << test::read_text(errors());
    const json result = json::parse(test::read_text(json_file()));
    EXPECT_EQ(result["graph"]["complete"], true);
    EXPECT_FALSE(result["graph"].contains("failure"));
    ASSERT_EQ(result["graph"]["ways"].size(), 4U);
    ASSERT_EQ(result["ratios"].size(), 3U);
    EXPECT_EQ(result["ratios"][0]["name"], "frames lost, 640x480, 30 fps, 5 processes");
    EXPECT_THAT(result["ratios"][0]["verdict"], HasSubstr("for 2 s at 640x480"));
    EXPECT_EQ(result["ratios"][0]["stretch_met"], false);
    EXPECT_EQ(result["ratios"][1]["name"], "capture-to-posts p50, process graph ÷ one process");
    EXPECT_EQ(result["ratios"][2]["name"], "copies of a frame between driver and detector");
    EXPECT_EQ(result["ratios"][2]["ratio"], 0.0);
    EXPECT_THAT(leftovers(), IsEmpty());
}

TEST_F(GraphCommand, CtrlCEndsItWithoutAnythingLeft) {
    const pid_t bench = start("600");
    EXPECT_TRUE(wait_for_module(bench));
    ::kill(bench, SIGINT);
    EXPECT_EQ(wait_for(bench), 130);
    EXPECT_FALSE(fs::exists(json_file()));
    EXPECT_THAT(leftovers(), IsEmpty());
    EXPECT_FALSE(module(bench));
}

TEST_F(GraphCommand, AModuleThatDiesFailsTheRunAndItsRowsAreNotClaimed) {
    const pid_t bench = start("600");
    const auto victim = wait_for_module(bench);
    if (victim) ::kill(*victim, SIGKILL);
    EXPECT_TRUE(victim);
    EXPECT_EQ(wait_for(bench), 1);
    EXPECT_THAT(test::read_text(errors()), HasSubstr("segmentation"));
    const json result = json::parse(test::read_text(json_file()));
    EXPECT_EQ(result["graph"]["complete"], false);
    EXPECT_THAT(result["graph"]["failure"], HasSubstr("segmentation"));
    for (const json& row : result["ratios"]) {
        EXPECT_TRUE(row["ratio"].is_null()) << row;
        EXPECT_EQ(row["met"], false) << row;
    }
    EXPECT_THAT(leftovers(), IsEmpty());
    EXPECT_FALSE(module(bench));
}

}  // namespace
}  // namespace goalmouth
