#pragma once

#include "tools/evaluate/images_run.h"
#include "tools/goalmouth/verbs.h"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace goalmouth {

struct ColourMatrixOptions {
    ImagesOptions images;
    std::vector<std::string> tables;  // FILE.gmct, or FORMAT:FILE of another team's (ForeignFormat)
};

/// One table, or way to one, on every set.
struct ColourMatrixRow {
    std::string table;   // for people
    std::string learnt;  // "annotations", "pictures", or "" for a table that was there
    std::string from;    // the set it was learnt from; "" for a table that was there
    std::vector<ImageSetResult> sets;
};

/// How each table does on each set: those learnt from a set's annotations, those learnt from its pictures
/// alone (on the set itself each without the pictures it is judged on, on others from all of them), and those
/// that were there. Once `progress` says stop no further table is learnt, and rows are missing or incomplete.
/// Throws ConfigurationError.
std::vector<ColourMatrixRow> colour_matrix(const ColourMatrixOptions& options,
                                           const ImagesProgress& progress);

/// How the table learnt from the set's own pictures does against the best of those that were there, with this
/// detector, by the harmonic mean of recall and precision: 1 better, 0 level, -1 worse. 1 where there is
/// none.
int learning_here_against_others(const std::vector<ColourMatrixRow>& rows, const std::string& set,
                                 const std::string& detector);

std::string colour_matrix_text(const std::vector<ColourMatrixRow>& rows,
                               const std::vector<std::string>& detectors);
nlohmann::ordered_json colour_matrix_json(const std::vector<ColourMatrixRow>& rows,
                                          const std::vector<std::string>& detectors);

/// `goalmouth evaluate colours`.
void add_evaluate_colours(CLI::App& evaluate, Action& action);

}  // namespace goalmouth
