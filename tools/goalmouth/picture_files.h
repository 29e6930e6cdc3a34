#pragma once

#include <string>
#include <vector>

namespace goalmouth {

/// Folders become the pictures in them, by name; other names stay as they are. Throws ConfigurationError for
/// a folder without a picture.
std::vector<std::string> picture_files(const std::vector<std::string>& named);

}  // namespace goalmouth
