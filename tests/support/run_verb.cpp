#include "tests/support/run_verb.h"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace goalmouth::test {

int run_verb(const std::function<void(CLI::App&, Action&)>& add, std::vector<std::string> arguments) {
    CLI::App app;
    Action action;
    add(app, action);
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
    return action();
}

}  // namespace goalmouth::test
