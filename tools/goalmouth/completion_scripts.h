#pragma once

#include <string>
#include <vector>

namespace goalmouth {

/// What may stand where a value is expected.
struct CompletedValue {
    std::string name;                // "FILE", as the help shows it
    std::vector<std::string> words;  // fixed words
    bool files = false;
    bool folders = false;
};

struct CompletedOption {
    std::vector<std::string> names;  // "--seconds", "-s"
    std::string description;
    bool takes_value = false;
    bool repeatable = false;
    CompletedValue value;
};

/// A command line's grammar, as much of it as completion needs.
struct CompletedCommand {
    std::string name;
    std::string description;
    std::vector<CompletedOption> options;
    std::vector<CompletedValue> positionals;
    std::vector<CompletedCommand> subcommands;
};

// The script that makes the shell complete `program`.
std::string bash_completion(const CompletedCommand& program);
std::string zsh_completion(const CompletedCommand& program);
std::string fish_completion(const CompletedCommand& program);

}  // namespace goalmouth
