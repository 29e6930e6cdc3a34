#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace goalmouth {

/// How a short-lived program ended.
struct CommandResult {
    bool started = false;    // false: it could not be run; `error` says why
    bool timed_out = false;  // it was killed
    int status = 0;          // as waitpid gives it
    std::string output;      // standard output
    std::string error;       // standard error

    bool succeeded() const { return started && !timed_out && status == 0; }
};

/// Runs a program to its end (it is searched on PATH where it holds no '/'), with `input` as its standard
/// input.
CommandResult run_command(const std::vector<std::string>& command, std::chrono::milliseconds limit,
                          const std::string& input = {});

/// "exit code 1", "killed by SIGSEGV (11)": for a status as waitpid gives it.
std::string end_text(int status);

}  // namespace goalmouth
