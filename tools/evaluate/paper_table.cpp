#include "tools/evaluate/paper_table.h"

#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_facts.h"
#include "tools/evaluate/paper_summary.h"

#include <fmt/format.h>
#include <optional>
#include <string>

namespace goalmouth {
namespace {

std::string centimetres(const std::optional<ErrorStatistics>& distance, double ErrorStatistics::*value) {
    return distance ? fmt::format("{:9.2f}", 100.0 * (*distance).*value) : std::string("        -");
}

/// "600 cm  81.2 %", "none missed".
std::string fewest_found(const RecordTable& table, std::size_t detector, std::size_t scene,
                         const std::optional<int>& cell) {
    if (!cell) return "-";
    const Summary summary = table.cell(detector, scene, *cell);
    if (summary.detected == summary.posts) return "none missed";
    return fmt::format("{} cm {:5.1f} %", evaluation_cell(*cell).distance_cm,
                       100.0 * summary.detection_rate());
}

/// "530 cm  45.1 cm".
std::string largest_rmse(const RecordTable& table, std::size_t detector, std::size_t scene,
                         const std::optional<int>& cell) {
    if (!cell) return "-";
    return fmt::format("{} cm {:6.1f} cm", evaluation_cell(*cell).distance_cm,
                       100.0 * table.cell(detector, scene, *cell).in_line.distance->rmse);
}

}  // namespace

std::string paper_table(const PaperResult& result) {
    const RecordTable table(result.records, result.scenes.size());
    std::string text;
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        for (std::size_t s = 0; s < result.scenes.size(); ++s) {
            const auto paper = paper_figures(result.detectors[d]);
            text += (text.empty() ? "" : "\n") + result.detectors[d] + ", scene " + result.scenes[s] + ", " +
                    result.options.size + "\n";
            text +=
                "  tilt  frames  detected  false/frame  RMSE cm  bias cm  paper's RMSE    fewest found     "
                "largest RMSE\n";
            for (std::size_t t = 0; t < cell_tilts_deg.size(); ++t) {
                const Summary tilt = table.tilt(d, s, t);
                const std::string rate =
                    tilt.posts > 0 ? fmt::format("{:7.2f} %", 100.0 * tilt.detection_rate()) : "        -";
                text += fmt::format("  {:3}°  {:6} {}  {:11.3f}", cell_tilts_deg[t], tilt.frames, rate,
                                    tilt.false_per_frame());
                text += centimetres(tilt.in_line.distance, &ErrorStatistics::rmse);
                text += centimetres(tilt.in_line.distance, &ErrorStatistics::bias);
                text += paper && paper->rmse_cm[t] ? fmt::format("  {:12.2f}", *paper->rmse_cm[t])
                                                   : std::string("             -");
                const WorstCells worst = worst_cells(table, d, s, t);
                text += fmt::format("  {:>14}  {:>15}\n", fewest_found(table, d, s, worst.detection),
                                    largest_rmse(table, d, s, worst.distance));
            }
        }
    }
    return text;
}

}  // namespace goalmouth
