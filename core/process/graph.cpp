#include "core/process/graph.h"

#include "core/messaging/channels.h"
#include "core/process/graph_check.h"
#include "core/process/graph_file.h"
#include "core/process/graph_program.h"
#include "core/process/paths.h"
#include "core/process/text.h"

#include <algorithm>

#include <yaml-cpp/yaml.h>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

const char* const tap_executable = "tap";

bool runs_tap(const ProcessEntry& entry) {
    return entry.executable && entry.executable->text == tap_executable;
}

/// Lays --tap over the graph: what it says of recorded pictures.
void apply_tap(GraphFile& file, const std::string& tap) {
    if (tap.empty()) return;
    const Place place{"--tap", 0};
    const fs::path folder = fs::current_path();
    if (tap == "off") {
        std::erase_if(file.processes, runs_tap);
        return;
    }
    if (tap != "raw" && tap != "jpeg") {
        throw ConfigurationError("--tap: '" + tap + "' is not one of: raw, jpeg, off");
    }
    if (std::none_of(file.processes.begin(), file.processes.end(), runs_tap)) {
        ProcessEntry entry;
        entry.name = tap_executable;
        entry.place = place;
        entry.executable = PlacedText{tap_executable, place, folder};
        file.processes.push_back(std::move(entry));
    }
    for (auto& entry : file.processes) {
        if (!runs_tap(entry)) continue;
        entry.enabled = true;
        entry.parameters.push_back({"encoding", tap, place, folder});
        if (tap == "raw") entry.parameters.push_back({"every", "1", place, folder});
    }
}

/// "PROCESS.KEY=VALUE" into the entry of that process.
void apply_setting(GraphFile& file, const std::string& text) {
    const auto equals = text.find('=');
    const auto dot = text.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals) {
        throw ConfigurationError("--set: '" + text + "' is not of the form PROCESS.KEY=VALUE");
    }
    const std::string name = text.substr(0, dot);
    std::vector<std::string> names;
    for (auto& entry : file.processes) {
        names.push_back(entry.name);
        if (entry.name != name) continue;
        entry.parameters.push_back({text.substr(dot + 1, equals - dot - 1),
                                    text.substr(equals + 1),
                                    {"--set", 0},
                                    fs::current_path()});
        return;
    }
    throw ConfigurationError("--set: the graph has no process '" + name + "'; " + suggestion(name, names));
}

std::vector<ChannelUse> uses_of(const std::optional<std::vector<PlacedChannelUse>>& placed) {
    std::vector<ChannelUse> uses;
    if (placed) {
        for (const auto& item : *placed) uses.push_back(item.use);
    }
    return uses;
}

void describe(GraphProcess& process, const ProcessEntry& entry, const GraphOptions& options) {
    const std::string where = entry.executable->place.text() + ": " + entry.name;
    if (options.describe && options.describe(process.executable, process.description)) {
        process.described = true;
        return;
    }
    process.program = find_program(process.executable, entry.executable->folder, where);
    if (entry.subscribes || entry.publishes) {
        process.description.info.executable = process.executable;
        process.description.info.subscribes = uses_of(entry.subscribes);
        process.description.info.publishes = uses_of(entry.publishes);
    } else {
        process.description = ask_program(process.program, where);
        process.described = true;
    }
}

void choose_config(GraphProcess& process, const ProcessEntry& entry) {
    if (entry.config) {
        const fs::path named = entry.config->text;
        process.config = (named.is_absolute() ? named : entry.config->folder / named).lexically_normal();
        std::error_code ignored;
        if (!fs::is_regular_file(process.config, ignored)) {
            throw ConfigurationError(entry.config->place.text() + ": " + process.name +
                                     ": config: " + process.config.string() +
                                     " does not exist; a path counts from the graph file");
        }
    } else if (process.described) {
        const fs::path usual = config_folder() / "modules" / (process.description.info.executable + ".yaml");
        if (fs::exists(usual)) process.config = usual;
    }
}

void choose_channels(GraphProcess& process, const ProcessEntry& entry) {
    std::vector<std::string> known;
    for (const auto& use : process.description.info.subscribes) known.push_back(use.channel);
    for (const auto& use : process.description.info.publishes) known.push_back(use.channel);
    known.emplace_back(channels::status);
    for (const auto& [from, to] : entry.channels) {
        if (std::find(known.begin(), known.end(), from.text) == known.end()) {
            throw ConfigurationError(from.place.text() + ": " + process.name +
                                     ": channels: " + process.executable + " does not use a channel '" +
                                     from.text + "'; " + suggestion(from.text, known));
        }
        process.channels[from.text] = to.text;
    }
}

bool has_parameter(const GraphProcess& process, const std::string& key) {
    const auto& all = process.description.parameters;
    return std::any_of(all.begin(), all.end(), [&](const ParameterInfo& p) { return p.key == key; });
}

GraphProcess resolve(const ProcessEntry& entry, const std::vector<GraphSetting>& common,
                     const GraphOptions& options) {
    if (!entry.executable) {
        throw ConfigurationError(
            entry.place.text() + ": " + entry.name +
            ": has no 'executable'; valid: the name of a program beside goalmouth or on PATH, or a path");
    }
    GraphProcess process;
    process.name = entry.name;
    process.executable = entry.executable->text;
    process.place = entry.place;
    process.arguments = entry.arguments.value_or(std::vector<std::string>{});
    describe(process, entry, options);
    choose_config(process, entry);
    choose_channels(process, entry);
    for (const auto& setting : common) {
        if (has_parameter(process, setting.key)) process.settings.push_back(setting);
    }
    process.settings.insert(process.settings.end(), entry.parameters.begin(), entry.parameters.end());
    return process;
}

}  // namespace

std::string GraphProcess::channel(const std::string& default_name) const {
    const auto found = channels.find(default_name);
    return found == channels.end() ? default_name : found->second;
}

Configuration GraphProcess::configuration() const {
    Configuration configuration = config.empty() ? Configuration() : Configuration::from_file(config);
    for (const auto& setting : settings) {
        configuration.set(setting.key, setting.value, setting.place.text(), setting.folder);
    }
    return configuration;
}

const GraphProcess* Graph::find(const std::string& process_name) const {
    const auto found = std::find_if(processes.begin(), processes.end(), [&](const GraphProcess& process) {
        return process.name == process_name;
    });
    return found == processes.end() ? nullptr : &*found;
}

fs::path find_graph(const std::string& file_or_name) {
    std::error_code ignored;
    if (fs::is_regular_file(file_or_name, ignored)) return file_or_name;
    const fs::path graphs = config_folder() / "graphs";
    for (const auto& file : {graphs / file_or_name, graphs / (file_or_name + ".yaml")}) {
        if (!file_or_name.empty() && fs::is_regular_file(file, ignored)) return file;
    }
    std::vector<std::string> known;
    for (const auto& entry : fs::directory_iterator(graphs, ignored)) {
        if (entry.path().extension() == ".yaml") known.push_back(entry.path().stem().string());
    }
    std::sort(known.begin(), known.end());
    throw ConfigurationError("no graph '" + file_or_name + "': neither a file nor one in " + graphs.string() +
                             "; " + suggestion(file_or_name, known));
}

Graph load_graph(const std::string& file_or_name, const GraphOptions& options) {
    const fs::path path = find_graph(file_or_name);
    GraphFile file = read_graph_file(path);
    apply_tap(file, options.tap);
    for (const auto& setting : options.settings) apply_setting(file, setting);
    std::erase_if(file.processes, [](const ProcessEntry& entry) { return !entry.enabled.value_or(true); });

    Graph graph;
    graph.file = file.file;
    graph.name = file.name;
    graph.seed = file.seed.value_or(graph.seed);
    if (file.lcm_url) {
        check_lcm_url(file.lcm_url->text, file.lcm_url->place.text());
        graph.lcm_url = file.lcm_url->text;
    }
    for (const auto& channel : file.external) graph.external.push_back(channel.text);
    if (file.processes.empty()) {
        throw ConfigurationError(file.file.string() +
                                 ": processes: there is none; expected a list of entries, each with 'name' "
                                 "and 'executable'");
    }
    for (const auto& entry : file.processes) graph.processes.push_back(resolve(entry, file.common, options));
    // What a graph that is extended has in common need not all be of use here.
    std::erase_if(file.common,
                  [&](const GraphSetting& setting) { return setting.place.file != path.string(); });
    check_parameters(graph, file.common);
    check_channels(graph, file.external);
    return graph;
}

std::string lcm_url_of(const Graph& graph, const std::string& asked) {
    if (!asked.empty()) {
        check_lcm_url(asked, "--lcm-url");
        return asked;
    }
    if (!graph.lcm_url.empty()) return graph.lcm_url;
    const std::string url = effective_lcm_url("");
    check_lcm_url(url, "$LCM_DEFAULT_URL");
    return url;
}

std::vector<std::string> command_line(const Graph& graph, const GraphProcess& process,
                                      const std::string& lcm_url) {
    std::vector<std::string> line = {
        process.program.string(),  "--name", process.name, "--lcm-url", lcm_url, "--seed",
        std::to_string(graph.seed)};
    if (!process.config.empty()) line.insert(line.end(), {"--config", process.config.string()});
    for (const auto& setting : process.settings) {
        const auto& all = process.description.parameters;
        const auto known = std::find_if(all.begin(), all.end(), [&](const ParameterInfo& parameter) {
            return parameter.key == setting.key;
        });
        std::string value = setting.value;
        if (known != all.end() && known->valid == "the name of a file") {
            // The process would count relative names from its own folder.
            const YAML::Node named = YAML::Load(value);
            if (named.IsScalar() && !named.Scalar().empty() && fs::path(named.Scalar()).is_relative()) {
                value = (setting.folder / named.Scalar()).lexically_normal().string();
            }
        }
        line.insert(line.end(), {"--set", setting.key + "=" + value});
    }
    for (const auto& [from, to] : process.channels) line.insert(line.end(), {"--channel", from + "=" + to});
    line.insert(line.end(), process.arguments.begin(), process.arguments.end());
    return line;
}

}  // namespace goalmouth
