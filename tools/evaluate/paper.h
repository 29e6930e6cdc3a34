#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_setup.h"

#include <string>

namespace goalmouth {

/// Where results go and how they are worked out: nothing of it changes them.
struct PaperTask {
    std::string json;            // file; "": none
    std::string report;          // folder; "": none
    std::optional<Shard> shard;  // nothing: the whole
    int jobs = 1;
};

/// Refuses before the work what cannot be written. Throws ConfigurationError.
void expect_outputs(const std::string& json, const std::string& report);

/// Runs, writes what is asked for, prints the table. The exit code: 0, or Interrupt::exit_code where a signal
/// came; then what was done is written all the same.
int evaluate_paper(const PaperOptions& options, const PaperSetup& setup, const PaperTask& task);

/// The command line that asks for the same.
std::string paper_command(const PaperOptions& options, const PaperTask& task);

}  // namespace goalmouth
