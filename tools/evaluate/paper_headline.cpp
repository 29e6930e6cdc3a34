#include "tools/evaluate/paper_headline.h"

#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_facts.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace goalmouth {
namespace {

constexpr const char* reference = "histogram";
constexpr const char* subject = "ransac";
constexpr std::size_t steepest = cell_tilts_deg.size() - 1;

std::optional<std::size_t> place_of(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

std::string what_was_measured(const PaperResult& result) {
    return fmt::format(
        "Posts were looked for in {} rendered frames of {}, {} at each of six distances (60 to 600 cm) and "
        "three tilts of the body (0, 10, 20°) in {} {}, by {}.",
        result.records.size(), result.options.size, result.options.frames_per_cell,
        result.scenes.size() == 1 ? "the scene" : "each of the scenes", enumeration(result.scenes),
        enumeration(result.detectors));
}

/// "" where one of the two was not run or measured nothing.
std::string comparison(const PaperResult& result, const RecordTable& table) {
    const auto before = place_of(result.detectors, reference);
    const auto after = place_of(result.detectors, subject);
    if (!before || !after) return {};
    std::vector<std::string> ratios;
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        const auto old_one = table.tilt(*before, s, steepest).in_line.distance;
        const auto new_one = table.tilt(*after, s, steepest).in_line.distance;
        if (!old_one || !new_one || new_one->rmse <= 0.0) continue;
        ratios.push_back(fmt::format("{:.1f}{} {}", old_one->rmse / new_one->rmse,
                                     ratios.empty() ? " times RANSAC's in scene" : " in", result.scenes[s]));
    }
    if (ratios.empty()) return {};
    return fmt::format(
        "At {}° of tilt the histogram's RMSE of the distance is {}; in the paper it was {:.1f} times "
        "RANSAC's.",
        cell_tilts_deg[steepest], enumeration(ratios),
        *paper_figures(reference)->rmse_cm[steepest] / *paper_figures(subject)->rmse_cm[steepest]);
}

std::string cell_text(const PaperResult& result, std::size_t scene, int cell) {
    const EvaluationCell at = evaluation_cell(cell);
    return fmt::format("scene {}, {} cm, {}°", result.scenes[scene], at.distance_cm, at.tilt_deg);
}

/// Over all scenes. "" where nothing was to be found.
std::string worst(const PaperResult& result, const RecordTable& table) {
    const std::size_t d = place_of(result.detectors, subject).value_or(0);
    std::string fewest;
    std::string largest;
    double lowest_rate = 2.0;
    double highest_rmse = -1.0;
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        const WorstCells cells = worst_cells(table, d, s);
        if (cells.detection) {
            const double rate = table.cell(d, s, *cells.detection).detection_rate();
            if (rate < lowest_rate) {
                lowest_rate = rate;
                fewest = fmt::format("finds fewest posts ({:.1f} %) in {}", 100.0 * rate,
                                     cell_text(result, s, *cells.detection));
            }
        }
        if (cells.distance) {
            const double rmse = table.cell(d, s, *cells.distance).in_line.distance->rmse;
            if (rmse > highest_rmse) {
                highest_rmse = rmse;
                largest = fmt::format("its RMSE is largest ({:.1f} cm) in {}", 100.0 * rmse,
                                      cell_text(result, s, *cells.distance));
            }
        }
    }
    if (fewest.empty()) return {};
    if (lowest_rate >= 1.0) fewest = "finds every post";
    const std::string name = result.detectors[d] == subject ? "RANSAC" : result.detectors[d];
    return name + " " + fewest + (largest.empty() ? "" : "; " + largest) + ".";
}

}  // namespace

std::string enumeration(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return text;
}

std::vector<std::string> paper_headline(const PaperResult& result, const RecordTable& table) {
    std::string findings = comparison(result, table);
    const std::string least = worst(result, table);
    if (!findings.empty() && !least.empty()) findings += " ";
    findings += least;
    std::vector<std::string> paragraphs = {what_was_measured(result)};
    if (!findings.empty()) paragraphs.push_back(findings);
    return paragraphs;
}

}  // namespace goalmouth
