#include "tools/evaluate/paper_table.h"

#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_acceptance.h"
#include "tools/evaluate/paper_facts.h"
#include "tools/evaluate/paper_settings.h"
#include "tools/evaluate/paper_summary.h"

#include <fmt/format.h>
#include <optional>
#include <string>

namespace goalmouth {
namespace {

std::string centimetres(const std::optional<ErrorStatistics>& distance, double ErrorStatistics::*value) {
    return distance ? fmt::format("{:9.2f}", 100.0 * (*distance).*value) : std::string("        -");
}

std::string ratio(const std::optional<double>& value, int width, int decimals) {
    return value ? fmt::format("{:{}.{}f}", *value, width, decimals) : fmt::format("{:>{}}", "-", width);
}

std::string good_share(const PostSummary& post, bool refines) {
    const auto share = post.good_share();
    return refines && share ? fmt::format("  {:5.1f} %", 100.0 * *share) : std::string("        -");
}

/// "over all frames, also those it does not call good: RMSE 3.10 / 4.20 / 4.11 cm".
std::string over_all_frames(const RecordTable& table, std::size_t detector, std::size_t scene) {
    std::string values;
    for (std::size_t t = 0; t < cell_tilts_deg.size(); ++t) {
        const auto all = table.tilt(detector, scene, t).in_line.all;
        values += (t == 0 ? "" : " / ") + (all ? fmt::format("{:.2f}", 100.0 * all->rmse) : std::string("-"));
    }
    return "  RMSE and bias are those of the frames it calls good; RMSE of all it measured: " + values +
           " cm\n";
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
    const RecordTable table(result.records, result.scenes.size(),
                            refining_detectors(result.settings, result.detectors));
    std::string text;
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        for (std::size_t s = 0; s < result.scenes.size(); ++s) {
            const auto paper = paper_figures(result.detectors[d]);
            text += (text.empty() ? "" : "\n") + result.detectors[d] + ", scene " + result.scenes[s] + ", " +
                    result.options.size + "\n";
            text +=
                "  tilt  frames  detected  false/frame  RMSE cm  bias cm  RMSE/bound  median/bound  called "
                "good  "
                "norm. error  paper's RMSE    fewest found     largest RMSE\n";
            for (std::size_t t = 0; t < cell_tilts_deg.size(); ++t) {
                const Summary tilt = table.tilt(d, s, t);
                const std::string rate =
                    tilt.posts > 0 ? fmt::format("{:7.2f} %", 100.0 * tilt.detection_rate()) : "        -";
                text += fmt::format("  {:3}°  {:6} {}  {:11.3f}", cell_tilts_deg[t], tilt.frames, rate,
                                    tilt.false_per_frame());
                text += centimetres(tilt.in_line.distance, &ErrorStatistics::rmse);
                text += centimetres(tilt.in_line.distance, &ErrorStatistics::bias);
                text += ratio(tilt.in_line.rmse_to_bound(), 12, 2);
                text += ratio(tilt.in_line.median_to_bound(), 14, 2);
                text += "    " + good_share(tilt.in_line, table.refines(d));
                text += ratio(tilt.in_line.normalised_error, 13, 2);
                text += paper && paper->rmse_cm[t] ? fmt::format("  {:12.2f}", *paper->rmse_cm[t])
                                                   : std::string("             -");
                const WorstCells worst = worst_cells(table, d, s, t);
                text += fmt::format("  {:>14}  {:>15}\n", fewest_found(table, d, s, worst.detection),
                                    largest_rmse(table, d, s, worst.distance));
            }
            if (table.refines(d)) text += over_all_frames(table, d, s);
        }
    }
    const auto lines = paper_acceptance(result, table);
    if (!lines.empty()) text += "\n";
    for (const AcceptanceLine& line : lines) text += line.text() + "\n";
    return text;
}

}  // namespace goalmouth
