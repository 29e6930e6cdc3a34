#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_setup.h"

#include <filesystem>

namespace goalmouth {

/// The page of a run: summary, tables, the paper's figures, worst failures as pictures. `setup`: what it was
/// run with, or nullptr; then it is set up from the result's options, and where that gives other settings
/// than those of the run, the page goes without pictures and says so. Throws ConfigurationError.
void write_paper_report(const PaperResult& result, const PaperSetup* setup,
                        const std::filesystem::path& folder);

}  // namespace goalmouth
