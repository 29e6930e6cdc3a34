#pragma once

#include "core/process/graph.h"
#include "core/process/graph_file.h"

#include <vector>

namespace goalmouth {

/// Checks that channels meet: every one that is needed is published, by one process only, with the type its
/// readers expect. Throws ConfigurationError for the first that does not.
void check_channels(const Graph& graph, const std::vector<PlacedText>& external);

/// Throws ConfigurationError for a `common` value that no process takes, and for a setting of a process that
/// its program does not know or whose value it does not take.
void check_parameters(const Graph& graph, const std::vector<GraphSetting>& common);

/// Throws ConfigurationError where processes cannot talk over `url`; `where` says where it was written.
void check_lcm_url(const std::string& url, const std::string& where);

}  // namespace goalmouth
