#include "tools/evaluate/paper_settings.h"

#include "core/process/configuration.h"
#include "tools/evaluate/file_hash.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

using Json = nlohmann::ordered_json;

/// Numbers, truth values and lists as such, all else as text.
Json value_as_json(const std::string& yaml) {
    Json value = Json::parse(yaml, nullptr, false);
    if (!value.is_discarded() && !value.is_object()) return value;
    if (yaml.find('/') != std::string::npos) return std::filesystem::path(yaml).filename().string();
    return yaml;
}

/// Whether a parameter names a file that is there and whose content is not among the settings by itself.
bool is_data_file(const std::filesystem::path& file) {
    std::error_code ignored;
    return file.has_extension() && file.extension() != ".yaml" &&
           std::filesystem::is_regular_file(file, ignored);
}

template <class Parameters>
Json parameters_as_json(const Parameters& parameters) {
    Json j = Json::object();
    for (const ParameterInfo& each : list_parameters(parameters)) j[each.key] = value_as_json(each.value);
    return j;
}

}  // namespace

Json settings_as_json(const PaperGrid& grid) {
    Json j;
    j["field"] = parameters_as_json(grid.field);
    j["camera"] = parameters_as_json(grid.camera);
    j["scenes"] = Json::object();
    for (const EvaluationScene& scene : grid.scenes) {
        Json& of = j["scenes"][scene.name];
        of["view"] = parameters_as_json(scene.parameters);
        of["formation"] = parameters_as_json(scene.formation);
    }
    return j;
}

Json settings_as_json(const Graph& graph) {
    Json j = Json::object();
    for (const GraphProcess& process : graph.processes) {
        const auto& info = process.description.info;
        const bool source = std::any_of(info.publishes.begin(), info.publishes.end(),
                                        [](const ChannelUse& use) { return use.type == "image_t"; });
        if (source || process.description.parameters.empty()) continue;
        const Configuration configuration = process.configuration();
        Json& of = j[process.name];
        of["executable"] = process.executable;
        for (const ParameterInfo& each : process.description.parameters) {
            const std::string set = configuration.text(each.key);
            of[each.key] = value_as_json(set.empty() ? each.value : set);
            const std::string file = configuration.file(each.key);
            if (is_data_file(file)) of[each.key + hash_suffix] = file_hash(file);
        }
    }
    return j;
}

std::vector<bool> refining_detectors(const nlohmann::ordered_json& settings,
                                     const std::vector<std::string>& detectors) {
    std::vector<bool> refining;
    for (const std::string& name : detectors) {
        const auto graph = settings.value("detectors", nlohmann::ordered_json::object())
                               .value(name, nlohmann::ordered_json::object());
        refining.push_back(std::any_of(graph.begin(), graph.end(), [](const auto& process) {
            return process.is_object() && process.value("executable", "") == "refinement";
        }));
    }
    return refining;
}

}  // namespace goalmouth
