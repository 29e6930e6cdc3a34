#include "core/process/graph_program.h"

#include "core/process/launcher_command.h"
#include "core/process/paths.h"
#include "core/process/text.h"

#include <cstdlib>
#include <stdexcept>
#include <unistd.h>

#include <yaml-cpp/yaml.h>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

constexpr auto longest_answer = std::chrono::seconds(10);

bool is_program(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

std::string last_line(const std::string& text) {
    const auto end = text.find_last_not_of(" \n\r\t");
    if (end == std::string::npos) return {};
    const auto start = text.find_last_of('\n', end);
    return text.substr(start == std::string::npos ? 0 : start + 1,
                       end - (start == std::string::npos ? 0 : start + 1) + 1);
}

std::string field(const YAML::Node& map, const char* key) {
    const YAML::Node value = map[key];
    return value.IsDefined() && value.IsScalar() ? value.Scalar() : std::string();
}

std::vector<ChannelUse> channel_uses(const YAML::Node& list, const char* key) {
    std::vector<ChannelUse> uses;
    if (!list.IsDefined() || list.IsNull()) return uses;
    if (!list.IsSequence()) throw std::runtime_error(std::string(key) + " is not a list");
    for (const auto& item : list) {
        if (!item.IsMap() || field(item, "channel").empty()) {
            throw std::runtime_error(std::string(key) + " holds an entry without a channel");
        }
        uses.push_back({field(item, "channel"), field(item, "type"), field(item, "meaning"),
                        field(item, "optional") == "true"});
    }
    return uses;
}

}  // namespace

fs::path find_program(const std::string& executable, const fs::path& folder, const std::string& where) {
    std::vector<std::string> looked;
    if (executable.find('/') != std::string::npos) {
        const fs::path named = executable;
        const fs::path file = fs::absolute(named.is_absolute() ? named : folder / named).lexically_normal();
        if (is_program(file)) return file;
        std::error_code ignored;
        throw ConfigurationError(where + ": executable: " + file.string() +
                                 (fs::exists(file, ignored)
                                      ? " is not a program that may be run"
                                      : " does not exist; a path counts from the graph file"));
    }
    const fs::path beside = program_folder() / executable;
    if (is_program(beside)) return beside;
    const char* path = std::getenv("PATH");
    for (const auto& place : split(path ? path : "", ':')) {
        if (!place.empty() && is_program(fs::path(place) / executable))
            return fs::absolute(fs::path(place) / executable);
    }
    throw ConfigurationError(where + ": executable: no program '" + executable + "': looked in " +
                             program_folder().string() + " and on PATH (" + (path ? path : "not set") +
                             "); valid: the name of a program there, or a path with a '/'");
}

ProgramDescription parse_description(const std::string& text) {
    YAML::Node root;
    try {
        root = YAML::Load(text);
    } catch (const YAML::Exception& error) {
        throw std::runtime_error(std::string("it is not YAML: ") + error.what());
    }
    if (!root.IsMap() || !root["executable"].IsDefined())
        throw std::runtime_error("it has no key 'executable'");
    ProgramDescription description;
    description.info.executable = field(root, "executable");
    description.info.summary = field(root, "summary");
    description.info.subscribes = channel_uses(root["subscribes"], "subscribes");
    description.info.publishes = channel_uses(root["publishes"], "publishes");
    const YAML::Node parameters = root["parameters"];
    if (parameters.IsDefined() && !parameters.IsNull()) {
        if (!parameters.IsSequence()) throw std::runtime_error("parameters is not a list");
        for (const auto& item : parameters) {
            if (!item.IsMap() || field(item, "key").empty())
                throw std::runtime_error("a parameter has no key");
            description.parameters.push_back({field(item, "key"), field(item, "value"), field(item, "valid"),
                                              field(item, "unit"), field(item, "meaning")});
        }
    }
    return description;
}

ProgramDescription ask_program(const fs::path& program, const std::string& where) {
    const CommandResult answer = run_command({program.string(), "--describe"}, longest_answer);
    const std::string hint =
        "; a program that does not answer --describe needs 'subscribes' and 'publishes' in its entry";
    const std::string asked = where + ": executable: asked '" + program.string() + " --describe': ";
    if (!answer.started) throw ConfigurationError(asked + answer.error);
    if (answer.timed_out) throw ConfigurationError(asked + "no answer within 10 s" + hint);
    if (!answer.succeeded()) {
        const std::string said = last_line(answer.error);
        throw ConfigurationError(asked + end_text(answer.status) + (said.empty() ? "" : " (" + said + ")") +
                                 hint);
    }
    try {
        return parse_description(answer.output);
    } catch (const std::runtime_error& error) {
        throw ConfigurationError(asked + "the answer is not a description: " + error.what() + hint);
    }
}

}  // namespace goalmouth
