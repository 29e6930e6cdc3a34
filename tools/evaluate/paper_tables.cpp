#include "tools/evaluate/paper_tables.h"

#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_acceptance.h"
#include "tools/evaluate/paper_facts.h"

#include <fmt/format.h>
#include <limits>
#include <optional>

namespace goalmouth {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double centimetres(const std::optional<ErrorStatistics>& distance, double ErrorStatistics::*value) {
    return distance ? 100.0 * (*distance).*value : nothing;
}

Cell percent(const Summary& summary) {
    return Cell(summary.posts > 0 ? 100.0 * summary.detection_rate() : nothing, 1);
}

std::string place(int cell) {
    const EvaluationCell at = evaluation_cell(cell);
    return fmt::format("{} cm, {}°", at.distance_cm, at.tilt_deg);
}

/// "600 cm, 20°: 3.2 %".
std::string fewest_found(const RecordTable& table, std::size_t detector, std::size_t scene,
                         const WorstCells& worst) {
    if (!worst.detection) return "–";
    const Summary cell = table.cell(detector, scene, *worst.detection);
    if (cell.detected == cell.posts) return "none missed";
    return fmt::format("{}: {:.1f} %", place(*worst.detection), 100.0 * cell.detection_rate());
}

/// "600 cm, 20°: 41.3 cm".
std::string largest_rmse(const RecordTable& table, std::size_t detector, std::size_t scene,
                         const WorstCells& worst) {
    if (!worst.distance) return "–";
    const Summary cell = table.cell(detector, scene, *worst.distance);
    return fmt::format("{}: {:.1f} cm", place(*worst.distance),
                       centimetres(cell.in_line.distance, &ErrorStatistics::rmse));
}

std::vector<Cell> paper_row(const PaperFigures& paper) {
    std::vector<Cell> row = {"the paper (photographs)", paper.detector};
    for (std::size_t i = 0; i < cell_tilts_deg.size() + 1; ++i) row.emplace_back(nothing, 1);
    for (const auto& rmse : paper.rmse_cm) row.emplace_back(rmse.value_or(nothing), 1);
    row.insert(row.end(), {paper.fewest_found, "–"});
    return row;
}

}  // namespace

Table overview_table(const PaperResult& result, const RecordTable& table) {
    Table t;
    t.caption =
        "All six distances together. RMSE of the distance by width of the post in line; worst cell: where "
        "fewest posts were found, and where the RMSE is largest";
    t.columns = {"scene", "detector", "0°",  "10°",          "20°",         "a frame",
                 "0°",    "10°",      "20°", "fewest found", "largest RMSE"};
    t.groups = {{"", 2}, {"posts found, %", 3}, {"false posts", 1}, {"RMSE, cm", 3}, {"worst cell", 2}};
    for (const char* name : {"histogram", "ransac"}) t.rows.push_back(paper_row(*paper_figures(name)));
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        for (std::size_t d = 0; d < result.detectors.size(); ++d) {
            std::vector<Cell> row = {result.scenes[s], result.detectors[d]};
            for (std::size_t i = 0; i < cell_tilts_deg.size(); ++i)
                row.push_back(percent(table.tilt(d, s, i)));
            const Summary whole = table.whole(d, s);
            row.emplace_back(whole.frames > 0 ? whole.false_per_frame() : nothing, 2);
            for (std::size_t i = 0; i < cell_tilts_deg.size(); ++i)
                row.emplace_back(centimetres(table.tilt(d, s, i).in_line.distance, &ErrorStatistics::rmse), 1,
                                 Cell::Mark::strong);
            const WorstCells worst = worst_cells(table, d, s);
            row.insert(row.end(), {fewest_found(table, d, s, worst), largest_rmse(table, d, s, worst)});
            t.rows.push_back(row);
        }
    }
    return t;
}

Table tilt_table(const PaperResult& result, const RecordTable& table) {
    Table t;
    t.columns = {"scene",         "detector", "tilt °",  "frames",        "posts",       "found %",
                 "false a frame", "RMSE cm",  "bias cm", "median |e| cm", "95 % |e| cm", "measured"};
    t.groups = {{"", 4}, {"detection", 3}, {"distance of the post in line", 5}};
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        for (std::size_t d = 0; d < result.detectors.size(); ++d) {
            for (std::size_t i = 0; i < cell_tilts_deg.size(); ++i) {
                const Summary tilt = table.tilt(d, s, i);
                const auto& distance = tilt.in_line.distance;
                t.rows.push_back({result.scenes[s], result.detectors[d], Cell(cell_tilts_deg[i], 0),
                                  Cell(tilt.frames, 0), Cell(tilt.posts, 0), percent(tilt),
                                  Cell(tilt.false_per_frame(), 3),
                                  Cell(centimetres(distance, &ErrorStatistics::rmse), 2, Cell::Mark::strong),
                                  Cell(centimetres(distance, &ErrorStatistics::bias), 2),
                                  Cell(centimetres(distance, &ErrorStatistics::median_abs), 2),
                                  Cell(centimetres(distance, &ErrorStatistics::p95_abs), 2),
                                  Cell(tilt.in_line.measured, 0)});
            }
        }
    }
    return t;
}

Table cell_table(const PaperResult& result, const RecordTable& table, std::size_t detector,
                 std::size_t scene) {
    Table t;
    t.caption = result.detectors[detector];
    t.columns = {"cm",           "tilt °",   "posts",         "found %",     "false",   "RMSE cm",
                 "bias cm",      "σ cm",     "median |e| cm", "95 % |e| cm", "left px", "right px",
                 "bearing mrad", "measured", "bias cm",       "RMSE cm"};
    t.groups = {{"", 3}, {"detection", 2}, {"distance", 5}, {"edges and bearing", 3},
                {"", 1}, {"other post", 2}};
    for (int c = 0; c < cell_count; ++c) {
        const Summary cell = table.cell(detector, scene, c);
        const auto& distance = cell.in_line.distance;
        const auto& other = cell.second.distance;
        const auto edge = [&](std::size_t side) {
            return Cell(cell.in_line.edges ? (*cell.in_line.edges)[side] : nothing, 2);
        };
        t.rows.push_back({Cell(evaluation_cell(c).distance_cm, 0), Cell(evaluation_cell(c).tilt_deg, 0),
                          Cell(cell.posts, 0), percent(cell), Cell(cell.false_posts, 0),
                          Cell(centimetres(distance, &ErrorStatistics::rmse), 1, Cell::Mark::strong),
                          Cell(centimetres(distance, &ErrorStatistics::bias), 1),
                          Cell(centimetres(distance, &ErrorStatistics::sigma), 1),
                          Cell(centimetres(distance, &ErrorStatistics::median_abs), 1),
                          Cell(centimetres(distance, &ErrorStatistics::p95_abs), 1), edge(0), edge(1),
                          Cell(1000.0 * cell.in_line.bearing_rmse.value_or(nothing), 2),
                          Cell(cell.in_line.measured, 0), Cell(centimetres(other, &ErrorStatistics::bias), 1),
                          Cell(centimetres(other, &ErrorStatistics::rmse), 1)});
    }
    return t;
}

Table bound_table(const PaperResult& result, const RecordTable& table, std::size_t detector,
                  std::size_t scene) {
    Table t;
    t.caption = result.detectors[detector];
    t.columns = {"cm",         "tilt °",        "bound cm",         "RMSE cm", "bias cm",
                 "RMSE/bound", "|bias|/bar",    "median/bound",     "frames",  "both edges",
                 "identified", "called good %", "normalised error", "RMSE cm", "frames"};
    t.groups = {{"", 2},
                {table.refines(detector) ? "distance, frames called good" : "distance", 7},
                {"trust", 4},
                {"all it measured", 2}};
    const bool refines = table.refines(detector);
    for (int c = 0; c < cell_count; ++c) {
        const PostSummary post = table.cell(detector, scene, c).in_line;
        const auto good = post.good_share();
        t.rows.push_back({Cell(evaluation_cell(c).distance_cm, 0), Cell(evaluation_cell(c).tilt_deg, 0),
                          Cell(100.0 * post.bound.value_or(nothing), 3),
                          Cell(centimetres(post.distance, &ErrorStatistics::rmse), 3),
                          Cell(centimetres(post.distance, &ErrorStatistics::bias), 3),
                          Cell(post.rmse_to_bound().value_or(nothing), 2, Cell::Mark::strong),
                          Cell(bias_to_bar(post, evaluation_cell(c)).value_or(nothing), 2),
                          Cell(post.median_to_bound().value_or(nothing), 2), Cell(post.measured, 0),
                          Cell(post.both_edges, 0), Cell(post.both_edges_identified, 0),
                          Cell(refines && good ? 100.0 * *good : nothing, 1),
                          Cell(post.normalised_error.value_or(nothing), 2),
                          Cell(centimetres(post.all, &ErrorStatistics::rmse), 3),
                          Cell(post.all_measured, 0)});
    }
    return t;
}

}  // namespace goalmouth
