#pragma once

#include "tools/goalmouth/verbs.h"

namespace goalmouth {

/// `goalmouth evaluate` with its verbs.
void add_evaluate_verb(CLI::App& app, Action& action);

// The verbs of `goalmouth evaluate`; each sets `action` where it was given.
void add_evaluate_paper(CLI::App& evaluate, Action& action);
void add_evaluate_merge(CLI::App& evaluate, Action& action);

}  // namespace goalmouth
