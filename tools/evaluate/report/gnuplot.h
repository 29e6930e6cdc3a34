#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace goalmouth {

/// Runs gnuplot, found in $PATH, on `script` with `folder` as its working directory, where the script's files
/// appear; the user's own gnuplot settings are not read. Throws ConfigurationError where gnuplot is missing,
/// fails (with the last lines of what it said) or does not end in time; it is ended then.
void run_gnuplot(const std::string& script, const std::filesystem::path& folder,
                 std::chrono::milliseconds longest = std::chrono::minutes(1));

}  // namespace goalmouth
