#pragma once

#include "tools/evaluate/localisation_data.h"

#include <filesystem>
#include <string>

namespace goalmouth {

/// For a terminal: each detector's figures and the reductions beside the paper's.
std::string localisation_text(const LocalisationResult& result);

/// index.html: tables, paths on the field, errors over time and at the end. Throws ConfigurationError.
void write_localisation_report(const LocalisationResult& result, const std::filesystem::path& folder);

}  // namespace goalmouth
