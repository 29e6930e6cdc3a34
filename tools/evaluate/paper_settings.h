#pragma once

#include "core/process/graph.h"
#include "tools/evaluate/paper_run.h"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace goalmouth {

/// Every parameter of field, camera and scenes, by key.
nlohmann::ordered_json settings_as_json(const PaperGrid& grid);

/// What follows the key of a parameter that names a file, for the hash of its content (file_hash).
inline constexpr const char* hash_suffix = ".fnv1a";

/// Every parameter of every process of a graph that is one of ours, by process and key. Files by their names
/// alone, because folders differ from machine to machine, and those that are no YAML, such as colour tables,
/// by the hash of their content as well.
nlohmann::ordered_json settings_as_json(const Graph& graph);

/// Which of `detectors` have the program `refinement` in their graph, by the settings of a run.
std::vector<bool> refining_detectors(const nlohmann::ordered_json& settings,
                                     const std::vector<std::string>& detectors);

}  // namespace goalmouth
