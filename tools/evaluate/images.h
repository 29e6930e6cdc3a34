#pragma once

#include "tools/goalmouth/verbs.h"

namespace goalmouth {

/// `goalmouth evaluate images`: detectors against hand-annotated pictures.
void add_evaluate_images(CLI::App& evaluate, Action& action);

}  // namespace goalmouth
