#pragma once

#include "core/imaging/colour_rules.h"

#include <filesystem>
#include <string>
#include <vector>

namespace goalmouth {

/// What a rule file (docs/colour_tables.md) holds.
struct ColourRuleFile {
    std::string name;
    int bits = 6;
    std::vector<ColourRule> rules;
};

/// Throws ConfigurationError with file, line and what would be valid.
ColourRuleFile load_colour_rules(const std::filesystem::path& file);

}  // namespace goalmouth
