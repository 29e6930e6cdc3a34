#pragma once

#include "core/process/graph.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace goalmouth {

/// A text of a graph file and where it stands.
struct PlacedText {
    std::string text;
    Place place;
    std::filesystem::path folder;  // of the file it stands in
};

/// A channel a graph file says a program uses.
struct PlacedChannelUse {
    ChannelUse use;
    Place place;
};

/// One entry of `processes`, as written: nothing in it is checked against programs yet.
struct ProcessEntry {
    std::string name;
    Place place;
    std::optional<PlacedText> executable;
    std::optional<PlacedText> config;
    std::vector<GraphSetting> parameters;
    std::vector<std::pair<PlacedText, PlacedText>> channels;  // default name, new name
    std::optional<std::vector<std::string>> arguments;
    std::optional<std::vector<PlacedChannelUse>> subscribes;
    std::optional<std::vector<PlacedChannelUse>> publishes;
    std::optional<bool> enabled;
};

/// A graph file as written, with the one it extends merged in.
struct GraphFile {
    std::filesystem::path file;
    std::string name;
    std::optional<std::uint64_t> seed;
    std::optional<PlacedText> lcm_url;
    std::vector<GraphSetting> common;
    std::vector<PlacedText> external;
    std::vector<ProcessEntry> processes;
};

/// Reads a graph file and those it extends. In one that extends another: `seed`, `lcm_url` and `external`
/// replace, `common` is merged key by key, `processes` by name; an entry that names another executable starts
/// from nothing but its name and channels. Throws ConfigurationError for what is not a graph file.
GraphFile read_graph_file(const std::filesystem::path& file);

/// Says what is wrong with a channel name, "" where nothing is.
std::string channel_name_problem(const std::string& name);

}  // namespace goalmouth
