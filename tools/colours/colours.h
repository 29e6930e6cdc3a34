#pragma once

#include "tools/goalmouth/verbs.h"

namespace goalmouth {

/// Adds `learn` and `teach` to the verb `goalmouth colours`.
void add_colours_learn(CLI::App& colours_verb, Action& action);

}  // namespace goalmouth
