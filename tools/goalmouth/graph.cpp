#include "core/process/graph.h"

#include "core/process/launcher_command.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/verbs.h"

#include <filesystem>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

struct GraphVerbOptions {
    std::string graph;
    std::vector<std::string> settings;
    bool dot = false;
    std::string picture;
};

/// Has graphviz draw the picture in the format that the file's name asks for.
void draw(const std::string& dot, const std::filesystem::path& file) {
    const std::string format = file.extension() == ".png" ? "png" : file.extension() == ".svg" ? "svg" : "";
    if (format.empty())
        throw ConfigurationError("--output: " + file.string() + " is neither a .svg nor a .png");
    expect_writable(file, "--output");
    const CommandResult drawn = run_command({"dot", "-T" + format}, std::chrono::seconds(60), dot);
    if (!drawn.started) {
        throw std::runtime_error(
            "--output: pictures are drawn by graphviz's dot, which is not installed (apt install graphviz); "
            "--dot prints its input");
    }
    if (!drawn.succeeded())
        throw std::runtime_error("--output: dot: " + end_text(drawn.status) + ": " + drawn.error);
    write_text(file, drawn.output, "--output");
}

int show_graph(const GraphVerbOptions& options) {
    const Graph graph = load_graph(options.graph, {options.settings, {}, {}});
    if (options.dot) {
        std::cout << graph_as_dot(graph);
    } else if (options.picture.empty()) {
        std::cout << graph_as_table(graph);
    }
    if (!options.picture.empty()) {
        draw(graph_as_dot(graph), options.picture);
        std::cerr << "wrote " << options.picture << '\n';
    }
    return 0;
}

}  // namespace

void add_graph_verb(CLI::App& app, Action& action) {
    auto options = std::make_shared<GraphVerbOptions>();
    CLI::App* verb = app.add_subcommand("graph", "check a graph file, and print it as a table or a picture");
    verb->add_option("graph", options->graph, "graph file, or the name of one in config/graphs, e.g. refined")
        ->type_name("GRAPH")
        ->required();
    verb->add_option("--set", options->settings,
                     "one parameter of one process, over the graph's (repeatable)")
        ->type_name("PROCESS.KEY=VALUE")
        ->expected(1)
        ->take_all();
    verb->add_flag("--dot", options->dot, "print it in graphviz's language");
    verb->add_option("--output,-o", options->picture, "draw it into this .svg or .png")->type_name("FILE");
    verb->footer(
        "Exit code: 0 the graph is right, 2 it is not: file, line, key and what would be valid are said.");
    verb->callback([options, &action] { action = [options] { return show_graph(*options); }; });
}

}  // namespace goalmouth
