#include "tools/evaluate/paper_table.h"

#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_facts.h"
#include "tools/evaluate/paper_summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace goalmouth {
namespace {

std::string centimetres(const std::optional<ErrorStatistics>& distance, double ErrorStatistics::*value) {
    return distance ? fmt::format("{:9.2f}", 100.0 * (*distance).*value) : std::string("        -");
}

/// The cell with the lowest detection rate; of those, the one with the largest RMSE.
std::string worst_cell(const RecordTable& table, std::size_t detector, std::size_t scene, std::size_t tilt) {
    constexpr auto distances = static_cast<int>(cell_distances_cm.size());
    int worst = -1;
    double rate = 2.0;
    double rmse = 0.0;
    for (int i = 0; i < distances; ++i) {
        const Summary cell = table.cell(detector, scene, static_cast<int>(tilt) * distances + i);
        if (cell.posts == 0) continue;
        const double cell_rmse = cell.in_line.distance ? cell.in_line.distance->rmse : 0.0;
        if (cell.detection_rate() < rate || (cell.detection_rate() == rate && cell_rmse > rmse)) {
            worst = i;
            rate = cell.detection_rate();
            rmse = cell_rmse;
        }
    }
    if (worst < 0) return "-";
    return fmt::format("{} cm: {:.1f} %, {:.1f} cm", cell_distances_cm[static_cast<std::size_t>(worst)],
                       100.0 * rate, 100.0 * rmse);
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
                "  tilt  frames  detected  false/frame  RMSE cm  bias cm  paper's RMSE  worst cell: "
                "detected, RMSE\n";
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
                text += "  " + worst_cell(table, d, s, t) + "\n";
            }
        }
    }
    return text;
}

}  // namespace goalmouth
