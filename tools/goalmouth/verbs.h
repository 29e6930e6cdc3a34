#pragma once

#include <functional>

// Complete only where options are declared: CLI11 costs whoever includes it seconds.
namespace CLI {
class App;
}

namespace goalmouth {

/// What a verb does once the command line is read; the value is the exit code.
/// Throw ConfigurationError (exit 2) for what the user can mend, std::runtime_error (exit 1) for what failed.
using Action = std::function<int()>;

// Each adds its subcommand with options and, where that subcommand was given, sets `action`.
void add_bench_verb(CLI::App& app, Action& action);
/// Its subcommands can be added to.
CLI::App* add_colours_verb(CLI::App& app, Action& action);
void add_compare_verb(CLI::App& app, Action& action);
void add_detect_verb(CLI::App& app, Action& action);
void add_graph_verb(CLI::App& app, Action& action);
void add_launch_verb(CLI::App& app, Action& action);
void add_demo_verb(CLI::App& app, Action& action);
void add_spy_verb(CLI::App& app, Action& action);
void add_completion_verb(CLI::App& app, Action& action);

}  // namespace goalmouth
