#pragma once

#include "tools/goalmouth/verbs.h"

#include <filesystem>
#include <string>
#include <vector>

namespace goalmouth {

/// `goalmouth evaluate localisation`: the paper's walk to the ball, again and again.
void add_evaluate_localisation(CLI::App& evaluate, Action& action);

/// For `goalmouth evaluate merge`: joins shards of this verb, writes what is asked for and prints the table.
/// Unless `partial`, every run must be there. Throws ConfigurationError.
int merge_localisation(const std::vector<std::filesystem::path>& files, const std::string& json,
                       const std::filesystem::path& report, bool partial);

/// What such a file says at "what".
inline constexpr const char* localisation_what = "localisation";

}  // namespace goalmouth
