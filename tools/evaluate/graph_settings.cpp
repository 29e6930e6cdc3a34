#include "tools/evaluate/graph_settings.h"

#include "core/process/configuration.h"
#include "core/process/graph.h"
#include "core/process/text.h"
#include "tools/goalmouth/registry.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace goalmouth {
namespace {

Graph described(const std::string& graph, const std::vector<std::string>& settings = {}) {
    GraphOptions options;
    options.describe = describe_module;
    options.settings = settings;
    return load_graph(graph, options);
}

bool has_parameter(const Graph& graph, const std::string& setting) {
    const std::string path = setting.substr(0, setting.find('='));
    const auto dot = path.find('.');
    if (dot == std::string::npos) return false;
    const GraphProcess* process = graph.find(path.substr(0, dot));
    if (process == nullptr) return false;
    const auto& parameters = process->description.parameters;
    return std::any_of(parameters.begin(), parameters.end(),
                       [&](const ParameterInfo& p) { return p.key == path.substr(dot + 1); });
}

}  // namespace

std::vector<std::vector<std::string>> share_out_settings(const std::vector<std::string>& settings,
                                                         const std::vector<std::string>& graphs) {
    std::vector<std::vector<std::string>> shares(graphs.size());
    std::set<std::string> known;
    for (std::size_t i = 0; i < graphs.size(); ++i) {
        const Graph graph = described(graphs[i]);
        for (const std::string& setting : settings) {
            if (!has_parameter(graph, setting)) continue;
            shares[i].push_back(setting);
            known.insert(setting);
        }
    }
    for (const std::string& setting : settings) {
        if (known.contains(setting)) continue;
        described(graphs.front(), {setting});  // throws with what would be valid
        throw ConfigurationError("--set: no graph has a parameter '" + setting + "'");
    }
    return shares;
}

std::vector<std::string> graph_list(const std::string& text, const std::string& option) {
    const std::vector<std::string> graphs = split(text, ',');
    std::set<std::string> names;
    for (const std::string& graph : graphs) {
        if (graph.empty())
            throw ConfigurationError(option + ": \"" + text +
                                     "\" is no list of names with a comma between them");
        find_graph(graph);
        if (!names.insert(graph_name(graph)).second)
            throw ConfigurationError(option + ": '" + graph_name(graph) + "' is named twice");
    }
    if (graphs.empty()) throw ConfigurationError(option + ": names no graph");
    return graphs;
}

std::string graph_name(const std::string& file_or_name) {
    return std::filesystem::path(file_or_name).stem().string();
}

}  // namespace goalmouth
