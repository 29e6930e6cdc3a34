#include "core/process/configuration.h"
#include "core/process/text.h"
#include "tools/colours/colours.h"
#include "tools/evaluate/evaluate.h"
#include "tools/goalmouth/verbs.h"

#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

/// CLI11 says of a misspelt verb or option only that another is missing. Empty: nothing is misspelt.
std::string misspelt(const CLI::App& app) {
    const std::vector<std::string> unknown = app.remaining(true);
    if (unknown.empty()) return {};
    const CLI::App* verb = &app;
    while (!verb->get_subcommands().empty()) verb = verb->get_subcommands().front();
    std::vector<std::string> valid;
    const bool option = unknown.front().starts_with("-");
    if (option) {
        for (const CLI::Option* each : verb->get_options()) {
            if (!each->get_lnames().empty()) valid.push_back("--" + each->get_lnames().front());
        }
    } else {
        for (const CLI::App* each : verb->get_subcommands([](const CLI::App*) { return true; }))
            valid.push_back(each->get_name());
    }
    if (valid.empty()) return {};
    return verb->get_name() + ": unknown " + (option ? "option" : "verb") + " '" + unknown.front() + "'; " +
           goalmouth::suggestion(unknown.front(), valid);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Robot vision and localisation for RoboCup, as a graph of processes over LCM.", "goalmouth"};
    app.set_version_flag("--version", std::string("goalmouth ") + GOALMOUTH_VERSION);
    app.require_subcommand(1);
    app.fallthrough(false);
    goalmouth::Action action;
    goalmouth::add_demo_verb(app, action);
    goalmouth::add_launch_verb(app, action);
    goalmouth::add_graph_verb(app, action);
    goalmouth::add_detect_verb(app, action);
    goalmouth::add_compare_verb(app, action);
    goalmouth::add_evaluate_verb(app, action);
    goalmouth::add_bench_verb(app, action);
    goalmouth::add_colours_learn(*goalmouth::add_colours_verb(app, action), action);
    goalmouth::add_spy_verb(app, action);
    goalmouth::add_completion_verb(app, action);
    try {
        app.parse(argc, argv);
        return action();
    } catch (const CLI::ParseError& error) {
        const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
        const std::string mistake =
            code == CLI::ExitCodes::RequiredError || code == CLI::ExitCodes::ExtrasError ? misspelt(app)
                                                                                         : std::string();
        if (mistake.empty()) return app.exit(error) == 0 ? 0 : 2;
        std::cerr << mistake << '\n';
        return 2;
    } catch (const goalmouth::ConfigurationError& error) {
        std::cerr << "goalmouth: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "goalmouth: " << error.what() << '\n';
        return 1;
    }
}
