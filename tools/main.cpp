#include <exception>
#include <iostream>

#include "core/process/configuration.h"
#include "tools/goalmouth/verbs.h"

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
    goalmouth::add_colours_verb(app, action);
    goalmouth::add_spy_verb(app, action);
    goalmouth::add_completion_verb(app, action);
    try {
        app.parse(argc, argv);
        return action();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const goalmouth::ConfigurationError& error) {
        std::cerr << "goalmouth: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "goalmouth: " << error.what() << '\n';
        return 1;
    }
}
