#include "tools/goalmouth/completion_scripts.h"

#include <algorithm>
#include <functional>
#include <sstream>

namespace goalmouth {
namespace {

std::string join(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// For use between single quotes of a shell.
std::string shell_quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

using Visit = std::function<void(const CompletedCommand& command, const std::string& path)>;

/// Every command with the words that lead to it: "goalmouth", "goalmouth colours", "goalmouth colours train".
void for_each(const CompletedCommand& command, const std::string& path, const Visit& visit) {
    visit(command, path);
    for (const auto& inner : command.subcommands) for_each(inner, path + " " + inner.name, visit);
}

/// Everything that may stand as a positional argument.
CompletedValue all_positionals(const CompletedCommand& command) {
    CompletedValue all;
    for (const auto& value : command.positionals) {
        all.words.insert(all.words.end(), value.words.begin(), value.words.end());
        all.files = all.files || value.files;
        all.folders = all.folders || value.folders;
    }
    return all;
}

std::string bash_reply(const CompletedValue& value, const std::vector<std::string>& further = {}) {
    std::vector<std::string> words = value.words;
    words.insert(words.end(), further.begin(), further.end());
    const char* kind = value.files ? "-f " : value.folders ? "-d " : "";
    return std::string(value.files || value.folders ? "compopt -o filenames 2>/dev/null; " : "") +
           "COMPREPLY=($(compgen " + kind + "-W " + shell_quoted(join(words, " ")) + " -- \"$cur\"))";
}

/// ':' and brackets mean something in zsh's option descriptions.
std::string zsh_text(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

std::string zsh_action(const CompletedValue& value) {
    const std::string words = value.words.empty() ? "" : "(" + join(value.words, " ") + ")";
    if (value.files && !words.empty())
        return "{_alternative \"words:word:" + words + "\" \"files:file:_files\"}";
    if (value.files) return "_files";
    return value.folders ? "_files -/" : words;
}

std::string function_name(std::string path) {
    for (char& c : path) c = c == ' ' || c == '-' ? '_' : c;
    return "_" + path;
}

}  // namespace

std::string bash_completion(const CompletedCommand& program) {
    std::ostringstream steps;
    std::ostringstream replies;
    for_each(program, program.name, [&](const CompletedCommand& command, const std::string& path) {
        for (const auto& inner : command.subcommands) {
            steps << "            " << shell_quoted(path + " " + inner.name)
                  << ") path=" << shell_quoted(path + " " + inner.name) << " ;;\n";
        }
        replies << "        " << shell_quoted(path) << ")\n            case \"$prev\" in\n";
        std::vector<std::string> words;
        for (const auto& inner : command.subcommands) words.push_back(inner.name);
        for (const auto& option : command.options) {
            words.insert(words.end(), option.names.begin(), option.names.end());
            if (!option.takes_value) continue;
            replies << "                " << join(option.names, "|") << ") " << bash_reply(option.value)
                    << "; return ;;\n";
        }
        replies << "            esac\n            " << bash_reply(all_positionals(command), words) << " ;;\n";
    });
    const std::string function = function_name(program.name);
    return "# Completion of " + program.name + " for bash; printed by '" + program.name +
           " completion bash'.\n" + function +
           "() {\n    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} path=" +
           shell_quoted(program.name) +
           " word\n    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n        case \"$path $word\" "
           "in\n" +
           steps.str() + "        esac\n    done\n    case \"$path\" in\n" + replies.str() +
           "    esac\n}\ncomplete -F " + function + " " + program.name + "\n";
}

std::string zsh_completion(const CompletedCommand& program) {
    std::ostringstream out;
    out << "#compdef " << program.name << "\n# Completion of " << program.name << " for zsh; printed by '"
        << program.name << " completion zsh'.\n";
    for_each(program, program.name, [&](const CompletedCommand& command, const std::string& path) {
        out << function_name(path)
            << "() {\n    local context state state_descr line\n    typeset -A opt_args\n    _arguments -C";
        for (const auto& option : command.options) {
            for (const auto& name : option.names) {
                std::string spec =
                    (option.repeatable ? "*" : "") + name + "[" + zsh_text(option.description) + "]";
                if (option.takes_value)
                    spec += ":" + zsh_text(option.value.name) + ":" + zsh_action(option.value);
                out << " \\\n        " << shell_quoted(spec);
            }
        }
        if (!command.subcommands.empty()) {
            out << " \\\n        '1: :->verb' '*:: :->rest'";
        } else if (!command.positionals.empty()) {
            out << " \\\n        " << shell_quoted("*:argument:" + zsh_action(all_positionals(command)));
        }
        out << '\n';
        if (!command.subcommands.empty()) {
            out << "    case $state in\n        verb)\n            local -a verbs\n            verbs=(";
            for (const auto& inner : command.subcommands) {
                out << "\n                " << shell_quoted(inner.name + ":" + inner.description);
            }
            out << ")\n            _describe verb verbs ;;\n        rest)\n            case $line[1] in\n";
            for (const auto& inner : command.subcommands) {
                out << "                " << inner.name << ") " << function_name(path + " " + inner.name)
                    << " ;;\n";
            }
            out << "            esac ;;\n    esac\n";
        }
        out << "}\n";
    });
    out << "compdef " << function_name(program.name) << ' ' << program.name << '\n';
    return out.str();
}

std::string fish_completion(const CompletedCommand& program) {
    std::ostringstream out;
    out << "# Completion of " << program.name << " for fish; printed by '" << program.name
        << " completion fish'.\n"
        << "complete -c " << program.name << " -f\n";
    for_each(program, program.name, [&](const CompletedCommand& command, const std::string& path) {
        // Holds where every word of the path was given and none of the verbs below it.
        std::string condition;
        std::istringstream words(path);
        std::string word;
        words >> word;
        while (words >> word)
            condition +=
                (condition.empty() ? "" : "; and ") + std::string("__fish_seen_subcommand_from ") + word;
        if (!command.subcommands.empty()) {
            std::string inner;
            for (const auto& below : command.subcommands) inner += " " + below.name;
            condition +=
                (condition.empty() ? "" : "; and ") + std::string("not __fish_seen_subcommand_from") + inner;
        }
        const std::string start = "complete -c " + program.name + " -n " + shell_quoted(condition);
        for (const auto& below : command.subcommands) {
            out << start << " -a " << below.name << " -d " << shell_quoted(below.description) << '\n';
        }
        for (const auto& option : command.options) {
            out << start;
            for (const auto& name : option.names)
                out << (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
            if (option.takes_value) {
                out << (option.value.files ? " -r -F" : " -x");
                if (option.value.folders) out << " -a '(__fish_complete_directories)'";
                if (!option.value.words.empty()) out << " -a " << shell_quoted(join(option.value.words, " "));
            }
            out << " -d " << shell_quoted(option.description) << '\n';
        }
        const CompletedValue positional = all_positionals(command);
        if (positional.files) out << start << " -F\n";
        if (positional.folders && !positional.files) out << start << " -a '(__fish_complete_directories)'\n";
        if (!positional.words.empty())
            out << start << " -a " << shell_quoted(join(positional.words, " ")) << '\n';
    });
    return out.str();
}

}  // namespace goalmouth
