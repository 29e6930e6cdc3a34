#pragma once

#include <string>
#include <vector>

namespace goalmouth {

/// "a.b.c" at '.' → {"a", "b", "c"}.
std::vector<std::string> split(const std::string& text, char separator);

/// For an error about a word that is not among `valid`: "did you mean 'x'?" where one is close, and what is
/// valid.
std::string suggestion(const std::string& word, const std::vector<std::string>& valid);

}  // namespace goalmouth
