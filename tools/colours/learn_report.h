#pragma once

#include "core/colour_learning/colour_learner.h"
#include "tools/colours/learn.h"
#include "tools/colours/learning_pictures.h"

#include <vector>

namespace goalmouth {

/// The report's folder: index.html (what was learnt, how far to trust it, each picture beside what it taught
/// and what the table makes of it) and, beside it, contact_sheet.png, clusters.png and table.png. Throws
/// ConfigurationError.
void write_learn_report(const LearnColoursOptions& options, const std::vector<NamedPicture>& pictures,
                        const LearntColours& learnt);

}  // namespace goalmouth
