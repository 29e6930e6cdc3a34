#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/tools_evaluate_report/path_variable.h"

#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// scripts/evaluate_array.sbatch, run by bash as Slurm runs it, with a recorder in place of goalmouth.
namespace goalmouth {
namespace {

using testing::HasSubstr;

struct Outcome {
    int exit_code = -1;
    std::string output;  // stdout and stderr
};

class SlurmArray : public testing::Test {
  protected:
    void SetUp() override {
        // Says its arguments, one in brackets each, and writes the file that --json names.
        test::write_program(
            folder_.path(), "goalmouth",
            "for a in \"$@\"; do printf '[%s]' \"$a\"; done\n"
            "while [ $# -gt 1 ]; do [ \"$1\" = --json ] && echo '{}' > \"$2\"; shift; done\n");
        environment_ = {{"GOALMOUTH", path("goalmouth")}, {"SLURM_SUBMIT_DIR", folder_.path().string()}};
    }

    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    void array_task(int task, int count) {
        environment_["SLURM_ARRAY_TASK_ID"] = std::to_string(task);
        environment_["SLURM_ARRAY_TASK_COUNT"] = std::to_string(count);
        environment_["SLURM_ARRAY_TASK_MIN"] = "1";
        environment_["SLURM_ARRAY_TASK_MAX"] = std::to_string(count);
    }

    Outcome run(const std::string& arguments = "") const {
        std::string command = "env -i PATH=\"$PATH\"";
        for (const auto& [name, value] : environment_) command += " " + name + "='" + value + "'";
        command += " bash " GOALMOUTH_SOURCE_DIR "/scripts/evaluate_array.sbatch " + arguments + " 2>&1";
        Outcome outcome;
        FILE* pipe = ::popen(command.c_str(), "r");
        if (pipe == nullptr) return outcome;
        std::array<char, 4096> piece{};
        while (std::fgets(piece.data(), piece.size(), pipe) != nullptr) outcome.output += piece.data();
        const int status = ::pclose(pipe);
        if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
        return outcome;
    }

    test::TemporaryFolder folder_;
    std::map<std::string, std::string> environment_;
};

TEST_F(SlurmArray, TaskEvaluatesItsShard) {
    array_task(3, 40);
    environment_["SLURM_CPUS_PER_TASK"] = "8";
    const Outcome outcome = run("--scene match --size '1600x1200'");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.output,
              "[evaluate][paper][--scene][match][--size][1600x1200][--shard][3/40][--jobs][8][--json][" +
                  path("evaluation/shards-of-40/000003.json") + "]");
}

TEST_F(SlurmArray, MergesWhatTheTasksWrote) {
    for (int task = 1; task <= 3; ++task) {
        array_task(task, 3);
        ASSERT_EQ(run().exit_code, 0);
    }
    const std::string shards = path("evaluation/shards-of-3/00000");
    const Outcome outcome = run("merge 3");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.output, "[evaluate][merge][" + shards + "1.json][" + shards + "2.json][" + shards +
                                  "3.json][--json][" + path("evaluation/paper.json") + "][--report][" +
                                  path("evaluation/report") + "]");
}

TEST_F(SlurmArray, KeepsNamesWithBlanksWhole) {
    array_task(1, 1);
    environment_["GOALMOUTH_OUT"] = path("my results");
    EXPECT_THAT(run("--field 'my field.yaml'").output, HasSubstr("[--field][my field.yaml][--shard]"));
    EXPECT_THAT(run("merge 1").output, HasSubstr("[" + path("my results/shards-of-1/000001.json") + "]"));
}

TEST_F(SlurmArray, NamesTheTasksToRunAgain) {
    for (const int task : {1, 3}) {
        array_task(task, 4);
        ASSERT_EQ(run().exit_code, 0);
    }
    const Outcome outcome = run("merge 4");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr("no result of 2 of 4 tasks"));
    EXPECT_THAT(outcome.output, HasSubstr("GOALMOUTH_SHARDS=4 sbatch --array=2,4 "));

    environment_["GOALMOUTH_SHARDS"] = "4";
    for (const int task : {2, 4}) {
        array_task(task, 2);
        environment_["SLURM_ARRAY_TASK_MIN"] = "2";
        environment_["SLURM_ARRAY_TASK_MAX"] = "4";
        EXPECT_THAT(run().output, HasSubstr("[--shard][" + std::to_string(task) + "/4]"));
    }
    EXPECT_EQ(run("merge 4").exit_code, 0);
}

TEST_F(SlurmArray, DoesNotTakeAnOldResultForThatOfAFailedTask) {
    array_task(1, 1);
    ASSERT_EQ(run().exit_code, 0);
    test::write_program(folder_.path(), "goalmouth", "exit 2\n");
    EXPECT_EQ(run().exit_code, 2);
    EXPECT_THAT(run("merge 1").output, HasSubstr("no result of 1 of 1 tasks"));
}

TEST_F(SlurmArray, RefusesWhatWouldGiveHalfAResult) {
    EXPECT_THAT(run().output, HasSubstr("not a task of a job array"));
    array_task(7, 2);
    environment_["SLURM_ARRAY_TASK_MIN"] = "3";
    environment_["SLURM_ARRAY_TASK_MAX"] = "7";
    EXPECT_THAT(run().output, HasSubstr("tasks 3 to 7 are not 1 to 2: set GOALMOUTH_SHARDS"));
    environment_["GOALMOUTH_SHARDS"] = "5";
    EXPECT_THAT(run().output, HasSubstr("task 7 is none of 1 to 5"));
    environment_["GOALMOUTH_SHARDS"] = "many";
    EXPECT_THAT(run().output, HasSubstr("'many' is no number of parts"));
    environment_.erase("GOALMOUTH_SHARDS");
    array_task(1, 2);
    EXPECT_THAT(run("--report there").output, HasSubstr("--report is set by this script"));
    EXPECT_THAT(run("--jobs=4").output, HasSubstr("--jobs is set by this script"));
    EXPECT_THAT(run("merge").output, HasSubstr("merge N"));
    environment_["GOALMOUTH"] = path("nowhere");
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr("no program " + path("nowhere")));
    EXPECT_FALSE(std::filesystem::exists(path("evaluation")));
}

}  // namespace
}  // namespace goalmouth
