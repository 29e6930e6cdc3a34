#pragma once

#include "core/process/graph.h"
#include "tools/evaluate/paper_run.h"

#include <nlohmann/json.hpp>

namespace goalmouth {

/// Every parameter of field, camera and scenes, by key.
nlohmann::ordered_json settings_as_json(const PaperGrid& grid);

/// Every parameter of every process of a graph that is one of ours, by process and key. Files by their names
/// alone: folders differ from machine to machine.
nlohmann::ordered_json settings_as_json(const Graph& graph);

}  // namespace goalmouth
