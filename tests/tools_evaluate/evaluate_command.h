#pragma once

#include "tests/support/data.h"
#include "tools/evaluate/evaluate.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace goalmouth::test {

/// Runs `goalmouth evaluate …` in this process; files go to a folder of the test's own.
struct EvaluateCommand : testing::Test {
    std::string path(const std::string& name) const { return (folder.path() / name).string(); }

    /// Exit code; what it prints is kept in `printed`.
    int run(std::vector<std::string> arguments) {
        CLI::App app;
        Action action;
        add_evaluate_verb(app, action);
        arguments.insert(arguments.begin(), "evaluate");
        std::reverse(arguments.begin(), arguments.end());
        app.parse(arguments);
        testing::internal::CaptureStdout();
        int code = -1;
        try {
            code = action();
        } catch (...) {
            printed = testing::internal::GetCapturedStdout();
            throw;
        }
        printed = testing::internal::GetCapturedStdout();
        return code;
    }

    /// A grid of few frames, too small to see far, but quick.
    int small_paper(const std::string& json, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {
            "paper", "--frames-per-cell", frames_per_cell, "--size", "160x120", "--json", path(json)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    std::string text(const std::string& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    nlohmann::ordered_json json(const std::string& name) const {
        return nlohmann::ordered_json::parse(text(name));
    }
    void write(const std::string& name, const std::string& content) const {
        std::ofstream(path(name)) << content;
    }

    /// What it says where it refuses.
    std::string refusal(const std::vector<std::string>& arguments) {
        try {
            run(arguments);
        } catch (const std::exception& error) {
            return error.what();
        }
        return {};
    }

    TemporaryFolder folder;
    std::string frames_per_cell = "2";
    std::string printed;
};

}  // namespace goalmouth::test
