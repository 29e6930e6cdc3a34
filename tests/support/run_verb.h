#pragma once

#include "tools/goalmouth/verbs.h"

#include <functional>
#include <string>
#include <vector>

namespace goalmouth::test {

/// Reads `arguments`, the verb's name first, as the command line of what `add` adds, and does what they ask
/// for. Throws what main would turn into an exit code.
int run_verb(const std::function<void(CLI::App&, Action&)>& add, std::vector<std::string> arguments);

}  // namespace goalmouth::test
