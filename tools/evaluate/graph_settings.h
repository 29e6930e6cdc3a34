#pragma once

#include <string>
#include <vector>

namespace goalmouth {

/// For each graph (a file, or a name in config/graphs) the settings "PROCESS.KEY=VALUE" it has a parameter
/// for. Throws ConfigurationError for one that no graph has, saying what the first would take.
std::vector<std::vector<std::string>> share_out_settings(const std::vector<std::string>& settings,
                                                         const std::vector<std::string>& graphs);

/// "a,b" → the names, which by their stems are all different. Throws ConfigurationError that begins with
/// `option`, also for graphs that are not there.
std::vector<std::string> graph_list(const std::string& text, const std::string& option);

/// The name a graph goes by in a report: its file's stem.
std::string graph_name(const std::string& file_or_name);

}  // namespace goalmouth
