#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_run.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace goalmouth {

/// What a command line asks for, with every file read and checked.
struct PaperSetup {
    PaperGrid grid;
    std::vector<Detector> detectors;
    nlohmann::ordered_json settings;  // as PaperResult::settings
};

/// Throws ConfigurationError with one sentence for the first mistake.
PaperSetup set_up_paper(const PaperOptions& options);

/// A scene by its name in config/evaluation or by its file. Throws ConfigurationError, with near names.
EvaluationScene load_evaluation_scene(const std::string& name_or_file);

/// A graph, by its name in config/graphs or its file, as a detector. `settings` are those of options.settings
/// that the graph has a parameter for; `carry_over` as in ImageChainOptions.
Detector chain_detector(const std::string& graph, const std::vector<std::string>& settings,
                        const PaperOptions& options, bool carry_over = false);

}  // namespace goalmouth
