#include "tools/evaluate/colour_matrix.h"

#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "core/process/configuration.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/goalmouth/temporary_folder.h"

#include <algorithm>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

/// Loads a table that is there, ours or another team's.
ColourTable given_table(const std::string& text) {
    try {
        const auto colon = text.find(':');
        const auto format = colon == std::string::npos ? std::nullopt : foreign_format(text.substr(0, colon));
        return format ? import_colour_table(*format, text.substr(colon + 1)) : load_colour_table(text);
    } catch (const FileError& error) {
        throw ConfigurationError(std::string("--table: ") + error.what());
    }
}

double harmonic_mean(const ImageScore& score) {
    const double sum = score.recall() + score.precision();
    return score.found > 0 && sum > 0.0 ? 2.0 * score.recall() * score.precision() / sum : 0.0;
}

const ImageSetResult* of_set(const ColourMatrixRow& row, const std::string& set) {
    for (const ImageSetResult& result : row.sets)
        if (result.set == set) return &result;
    return nullptr;
}

class Matrix {
  public:
    Matrix(const ColourMatrixOptions& options, const ImagesProgress& progress)
        : options_(options.images), progress_(progress) {
        progress_.expect = {};
    }

    ColourMatrixRow learnt_from(const std::string& set, const std::vector<std::string>& sets,
                                bool without_labels) {
        ColourMatrixRow row{fmt::format("learnt from {}{}", set, without_labels ? "" : ", with annotations"),
                            without_labels ? "pictures" : "annotations",
                            set,
                            {}};
        options_.without_labels = without_labels;
        const fs::path file =
            tables_.path() / (set + (without_labels ? "_pictures" : "_annotations") + ".gmct");
        for (const std::string& on : sets) {
            if (stopped()) break;  // learning takes long, and asks nobody
            if (on != set && !fs::exists(file)) save_colour_table(table_of_set(options_, set), file);
            row.sets.push_back(evaluated(on, on == set ? fs::path() : file));
        }
        return row;
    }

    ColourMatrixRow given(const std::string& text, const std::vector<std::string>& sets) {
        const fs::path file = tables_.path() / fmt::format("given_{}.gmct", given_++);
        save_colour_table(given_table(text), file);
        ColourMatrixRow row{fs::path(text).filename().string(), "", "", {}};
        for (const std::string& on : sets) row.sets.push_back(evaluated(on, file));
        return row;
    }

    bool stopped() const { return progress_.stop && progress_.stop(); }

  private:
    ImageSetResult evaluated(const std::string& set, const fs::path& table) {
        ImagesOptions one = options_;
        one.sets = {set};
        one.colours = table;
        std::vector<ImageSetResult> results = evaluate_images(one, progress_);
        if (results.empty()) return {set, {}, {}, {}, {}, false};
        return std::move(results.front());
    }

    ImagesOptions options_;
    ImagesProgress progress_;
    TemporaryFolder tables_;
    int given_ = 0;
};

}  // namespace

std::vector<ColourMatrixRow> colour_matrix(const ColourMatrixOptions& options,
                                           const ImagesProgress& progress) {
    for (const std::string& table : options.tables) given_table(table);  // says beforehand what is wrong
    const std::vector<std::string> sets = sets_of(options.images);
    if (progress.expect)
        progress.expect(pictures_of(options.images) * (2 * sets.size() + options.tables.size()));
    Matrix matrix(options, progress);
    std::vector<ColourMatrixRow> rows;
    for (const bool without_labels : {true, false})
        for (const std::string& set : sets)
            if (!matrix.stopped()) rows.push_back(matrix.learnt_from(set, sets, without_labels));
    for (const std::string& table : options.tables)
        if (!matrix.stopped()) rows.push_back(matrix.given(table, sets));
    return rows;
}

int learning_here_against_others(const std::vector<ColourMatrixRow>& rows, const std::string& set,
                                 const std::string& detector) {
    double here = 0.0, best = -1.0;
    for (const ColourMatrixRow& row : rows) {
        const ImageSetResult* result = of_set(row, set);
        if (result == nullptr) continue;
        const double value = harmonic_mean(result->score(detector));
        if (row.learnt == "pictures" && row.from == set) here = value;
        if (row.learnt.empty()) best = std::max(best, value);
    }
    return here > best ? 1 : here < best ? -1 : 0;
}

std::string colour_matrix_text(const std::vector<ColourMatrixRow>& rows,
                               const std::vector<std::string>& detectors) {
    std::string text =
        "Recall / precision [%], posts found in pictures that show none; (*) the table never saw the "
        "picture it is judged on\n";
    if (rows.empty()) return text;
    std::size_t widest = 5;
    for (const ColourMatrixRow& row : rows) widest = std::max(widest, row.table.size());
    text += fmt::format("{:<{}}  {:<12}", "table", widest, "detector");
    for (const ImageSetResult& set : rows.front().sets) text += fmt::format("  {:>24}", set.set);
    text += '\n';
    for (const ColourMatrixRow& row : rows) {
        for (const std::string& detector : detectors) {
            text += fmt::format("{:<{}}  {:<12}", row.table, widest, graph_name(detector));
            for (const ImageSetResult& set : row.sets) {
                const ImageScore s = set.score(detector);
                text += fmt::format(
                    "  {:>24}", fmt::format("{}{:.1f} / {:.1f}, {} in {}", row.from == set.set ? "(*) " : "",
                                            100.0 * s.recall(), 100.0 * s.precision(), s.wrong_on_negatives,
                                            s.negatives));
            }
            text += '\n';
        }
    }
    const bool compared =
        std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.learnt.empty(); });
    for (const ImageSetResult& set : rows.front().sets) {
        for (const std::string& detector : detectors) {
            if (!compared) continue;
            const int against = learning_here_against_others(rows, set.set, detector);
            text += fmt::format("{}, {}: learning from the set's own pictures {}\n", set.set,
                                graph_name(detector),
                                against > 0   ? "beats every table that was there"
                                : against < 0 ? "does not beat every table that was there"
                                              : "is level with the best table that was there");
        }
    }
    return text;
}

nlohmann::ordered_json colour_matrix_json(const std::vector<ColourMatrixRow>& rows,
                                          const std::vector<std::string>& detectors) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const ColourMatrixRow& row : rows) {
        for (const ImageSetResult& set : row.sets) {
            for (const std::string& detector : detectors) {
                const ImageScore s = set.score(detector);
                all.push_back({{"table", row.table},
                               {"learnt_from", row.learnt},
                               {"of_set", row.from},
                               {"set", set.set},
                               {"detector", graph_name(detector)},
                               {"posts", s.posts},
                               {"found", s.found},
                               {"wrong", s.wrong},
                               {"recall", s.recall()},
                               {"precision", s.precision()},
                               {"negatives", s.negatives},
                               {"wrong_on_negatives", s.wrong_on_negatives}});
            }
        }
    }
    return all;
}

}  // namespace goalmouth
