#pragma once

#include "tools/evaluate/light_result.h"
#include "tools/goalmouth/temporary_folder.h"
#include "tools/goalmouth/verbs.h"

#include <memory>
#include <string>
#include <vector>

namespace goalmouth {

/// What a command line asks for, with every file read and checked.
struct LightSetup {
    LightGrid grid;
    std::vector<LightDetector> detectors;
    nlohmann::ordered_json settings;
    std::shared_ptr<const TemporaryFolder> graphs;  // that the detectors read
};

/// Each graph gets colours_adapt where it has none. Throws ConfigurationError with one sentence for the first
/// mistake.
LightSetup set_up_light(const LightOptions& options);

/// A page with the headlines, figures by brightness and by temperature, and a table. Throws
/// ConfigurationError.
void write_light_report(const LightResult& result, const std::filesystem::path& target);

/// `goalmouth evaluate light`.
void add_evaluate_light(CLI::App& evaluate, Action& action);

}  // namespace goalmouth
