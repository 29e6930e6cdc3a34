#pragma once

#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/refusal.h"
#include "tests/support/run_verb.h"
#include "tools/evaluate/evaluate.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace goalmouth::test {

/// Runs `goalmouth evaluate …` in this process; files go to a folder of the test's own.
struct EvaluateCommand : testing::Test {
    std::string path(const std::string& name) const { return (folder.path() / name).string(); }

    /// Exit code; what it prints is kept in `printed`.
    int run(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "evaluate");
        testing::internal::CaptureStdout();
        int code = -1;
        try {
            code = run_verb(add_evaluate_verb, std::move(arguments));
        } catch (...) {
            printed = testing::internal::GetCapturedStdout();
            throw;
        }
        printed = testing::internal::GetCapturedStdout();
        return code;
    }

    /// A grid of few frames, too small to see far, but quick.
    int small_paper(const std::string& json, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"paper",  "--frames-per-cell", frames_per_cell, "--size", size,
                                              "--json", path(json)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    std::string text(const std::string& name) const { return read_text(path(name)); }
    nlohmann::ordered_json json(const std::string& name) const {
        return nlohmann::ordered_json::parse(text(name));
    }
    /// The file's path.
    std::string write(const std::string& name, const std::string& content) const {
        write_text(path(name), content);
        return path(name);
    }

    /// What it says where it refuses a file or a value; misuse that CLI11 sees itself goes through.
    std::string refusal(const std::vector<std::string>& arguments) {
        return message_of([&] { run(arguments); });
    }

    TemporaryFolder folder;
    std::string frames_per_cell = "2";
    std::string size = "160x120";
    std::string printed;
};

}  // namespace goalmouth::test
