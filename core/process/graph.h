#pragma once

#include "core/messaging/multicast.h"
#include "core/process/configuration.h"
#include "core/process/module.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace goalmouth {

/// Where something of a graph was written: a line of a file, or "--set" with line 0.
struct Place {
    std::string file;
    int line = 0;
    std::string text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

/// One parameter of one process as a graph sets it, over the process's own configuration file.
struct GraphSetting {
    std::string key;    // "walk.speed" for a nested one
    std::string value;  // as YAML would hold it
    Place place;
    std::filesystem::path folder;  // relative file names count from here
};

/// What a program answers to `--describe`: how a graph knows what it reads, writes and can be told.
struct ProgramDescription {
    ModuleInfo info;
    std::vector<ParameterInfo> parameters;
};

/// One process of a graph, resolved: nothing in it needs the graph file any more.
struct GraphProcess {
    std::string name;
    std::string executable;  // as the graph names it, e.g. "detection_ransac"
    std::filesystem::path
        program;  // the file that runs, absolute; empty where GraphOptions::describe answered
    std::filesystem::path config;        // absolute; empty = every parameter at its default
    std::vector<GraphSetting> settings;  // `common` first, then the process's own: the last of a key holds
    std::map<std::string, std::string> channels;  // default name → name in this graph, where they differ
    std::vector<std::string> arguments;           // further arguments, behind ours
    ProgramDescription description;               // channels under their default names
    bool described =
        false;  // false: the graph file said what it subscribes and publishes, parameters are unknown
    Place place;

    /// The name of a channel in this graph.
    std::string channel(const std::string& default_name) const;
    /// The process's parameters: configuration file and settings, for a module that runs in this process.
    /// Throws ConfigurationError.
    Configuration configuration() const;
};

/// A set of processes and how they are connected, read from a YAML file (docs: config/graphs/README.md).
struct Graph {
    std::string name;
    std::filesystem::path file;  // absolute
    std::uint64_t seed = 1;
    std::string lcm_url;                  // "" = not said
    std::vector<std::string> external;    // channels published outside the graph
    std::vector<GraphProcess> processes;  // enabled ones, in the order of the file

    /// nullptr where there is none of this name.
    const GraphProcess* find(const std::string& process_name) const;
};

struct GraphOptions {
    /// "PROCESS.KEY=VALUE", as --set takes them: over everything in the file; relative file names count from
    /// the current folder.
    std::vector<std::string> settings;
    /// "raw", "jpeg" or "off" for every process that runs `tap` (one is added where there is none); "" = as
    /// the graph says.
    std::string tap;
    /// Describes programs without asking them: fills the description of the executable and returns true, or
    /// returns false: then the program is searched for and asked. A tool that holds the modules itself sets
    /// this.
    std::function<bool(const std::string& executable, ProgramDescription& description)> describe;
};

/// Reads and checks a graph: a file, or the name of one in config/graphs/ ("ransac"). Throws
/// ConfigurationError with file, line, key and what would be valid for the first mistake: keys and types,
/// programs that cannot be found, parameters that no program has, channels that nobody publishes, that two
/// publish, or whose types differ.
Graph load_graph(const std::string& file_or_name, const GraphOptions& options = {});

/// The file that `file_or_name` stands for. Throws ConfigurationError naming the places looked at.
std::filesystem::path find_graph(const std::string& file_or_name);

/// The URL a graph talks over: `asked` (a command line's --lcm-url) if not empty, else the graph's, else
/// $LCM_DEFAULT_URL, else default_lcm_url. Throws ConfigurationError where it is none that processes can talk
/// over.
std::string lcm_url_of(const Graph& graph, const std::string& asked = {});

/// The command line of a process: the program, then --name, --lcm-url, --seed, --config, --set, --channel and
/// its own arguments.
std::vector<std::string> command_line(const Graph& graph, const GraphProcess& process,
                                      const std::string& lcm_url);

/// The graph as a text table: process, program, what it reads and writes, parameters changed.
std::string graph_as_table(const Graph& graph);

/// The graph in graphviz's language: processes are boxes, channels arrows.
std::string graph_as_dot(const Graph& graph);

}  // namespace goalmouth
