#include "core/process/configuration.h"
#include "core/process/graph.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/light.h"
#include "tools/evaluate/paper_setup.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/registry.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

constexpr const char* adapter = "colours_adapt";

/// The graph's own file where it follows the light already; else one in `folder` that adds it.
fs::path adapting_graph(const std::string& graph, const fs::path& folder) {
    GraphOptions options;
    options.describe = describe_module;
    const Graph loaded = load_graph(graph, options);
    if (std::any_of(loaded.processes.begin(), loaded.processes.end(),
                    [](const GraphProcess& process) { return process.executable == adapter; }))
        return loaded.file;
    const fs::path file = folder / (graph_name(graph) + ".yaml");
    write_text(file,
               "extends: '" + loaded.file.string() + "'\nprocesses:\n  - {name: " + adapter +
                   ", executable: " + adapter + "}\n",
               "");
    return file;
}

std::vector<LightPlace> lights_of(const LightOptions& options, double own_temperature) {
    std::vector<LightPlace> lights = {{1.0, own_temperature}};
    const auto add = [&](const LightPlace& light) {
        if (std::find(lights.begin(), lights.end(), light) == lights.end()) lights.push_back(light);
    };
    for (const double brightness : options.brightness) add({brightness, own_temperature});
    for (const double temperature : options.temperatures) add({1.0, temperature});
    if (options.brightness.empty() || options.temperatures.empty()) return lights;
    const auto [darkest, brightest] =
        std::minmax_element(options.brightness.begin(), options.brightness.end());
    const auto [warmest, coldest] =
        std::minmax_element(options.temperatures.begin(), options.temperatures.end());
    for (const double brightness : {*darkest, *brightest})
        for (const double temperature : {*warmest, *coldest}) add({brightness, temperature});
    return lights;
}

}  // namespace

LightSetup set_up_light(const LightOptions& options) {
    for (const double value : options.brightness)
        if (!std::isfinite(value)) throw ConfigurationError("--brightness: no number");
    for (const double value : options.temperatures)
        if (!std::isfinite(value)) throw ConfigurationError("--temperature: no number");
    LightSetup setup;
    const auto folder = std::make_shared<const TemporaryFolder>();
    setup.graphs = folder;
    PaperOptions paper = options.paper;
    std::vector<std::string> graphs;
    for (const std::string& graph : graph_list(options.paper.detectors, "--detectors"))
        graphs.push_back(adapting_graph(graph, folder->path()).string());
    paper.detectors.clear();
    for (const std::string& graph : graphs) paper.detectors += (paper.detectors.empty() ? "" : ",") + graph;
    const PaperSetup fixed = set_up_paper(paper);
    if (fixed.grid.scenes.size() != 1)
        throw ConfigurationError("--scene: one scene at a time, not \"" + options.paper.scenes + "\"");
    setup.grid.paper = fixed.grid;
    setup.settings = fixed.settings;
    setup.grid.lights = lights_of(options, fixed.grid.scenes.front().formation.light.temperature);
    const auto shares = share_out_settings(options.paper.settings, graphs);
    for (std::size_t i = 0; i < graphs.size(); ++i)
        setup.detectors.push_back({fixed.detectors[i].name,
                                   chain_detector(graphs[i], shares[i], paper, true).make,
                                   fixed.detectors[i].make});
    return setup;
}

}  // namespace goalmouth
