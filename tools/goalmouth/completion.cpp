#include "core/process/configuration.h"
#include "core/process/paths.h"
#include "tools/goalmouth/completion_scripts.h"
#include "tools/goalmouth/verbs.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

/// Names of the graphs in config/graphs/.
std::vector<std::string> graph_names() {
    std::vector<std::string> names;
    try {
        for (const auto& entry : std::filesystem::directory_iterator(config_folder() / "graphs")) {
            if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
        }
    } catch (const std::exception&) {
        return {};  // files still complete
    }
    std::sort(names.begin(), names.end());
    return names;
}

CompletedValue value_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    CompletedValue value;
    value.name = type.substr(0, type.find_first_of(":{ "));
    const auto open = type.find('{');
    const auto close = type.find('}');
    if (open != std::string::npos && close != std::string::npos) {
        std::string word;
        for (std::size_t i = open + 1; i <= close; ++i) {
            if (type[i] == ',' || type[i] == '}') {
                value.words.push_back(word);
                word.clear();
            } else {
                word += type[i];
            }
        }
    }
    const auto mentions = [&](const char* kind) { return type.find(kind) != std::string::npos; };
    value.files = mentions("FILE") || mentions("IMAGE") || mentions("PATH");
    value.folders = mentions("DIR");
    if (mentions("GRAPH")) {
        value.files = true;
        value.words = graph_names();
    }
    return value;
}

CompletedCommand command_of(const CLI::App& app) {
    CompletedCommand command{app.get_name(), app.get_description(), {}, {}, {}};
    for (const CLI::Option* option : app.get_options()) {
        if (option->nonpositional()) {
            CompletedOption completed;
            for (const auto& name : option->get_lnames()) completed.names.push_back("--" + name);
            for (const auto& name : option->get_snames()) completed.names.push_back("-" + name);
            completed.description = option->get_description();
            completed.takes_value = option->get_items_expected_max() > 0;
            completed.repeatable = option->get_items_expected_max() > 1 ||
                                   option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
            if (completed.takes_value) completed.value = value_of(*option);
            command.options.push_back(std::move(completed));
        } else {
            command.positionals.push_back(value_of(*option));
        }
    }
    for (const CLI::App* inner : app.get_subcommands([](const CLI::App*) { return true; })) {
        command.subcommands.push_back(command_of(*inner));
    }
    return command;
}

}  // namespace

void add_completion_verb(CLI::App& app, Action& action) {
    auto shell = std::make_shared<std::string>();
    CLI::App* verb =
        app.add_subcommand("completion", "print what makes a shell complete goalmouth's command lines");
    verb->add_option("shell", *shell, "the shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
    verb->footer(
        "bash:  source <(goalmouth completion bash)          in ~/.bashrc\n"
        "zsh:   source <(goalmouth completion zsh)           in ~/.zshrc, after compinit\n"
        "fish:  goalmouth completion fish > ~/.config/fish/completions/goalmouth.fish");
    verb->callback([shell, &app, &action] {
        action = [shell, &app] {
            const CompletedCommand command = command_of(app);
            std::cout << (*shell == "bash"  ? bash_completion(command)
                          : *shell == "zsh" ? zsh_completion(command)
                                            : fish_completion(command));
            return 0;
        };
    });
}

}  // namespace goalmouth
