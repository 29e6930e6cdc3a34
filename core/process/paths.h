#pragma once

#include <filesystem>

namespace goalmouth {

/// Folder of the running program.
std::filesystem::path program_folder();

/// The installation's config/ folder: $GOALMOUTH_CONFIG, or as installed (bin/../share/goalmouth/config),
/// or beside the build (bin/../../config), the first that exists. Throws ConfigurationError naming the places
/// looked at.
std::filesystem::path config_folder();

}  // namespace goalmouth
