#include "tools/evaluate/paper_report.h"

#include "core/evaluation/cell.h"
#include "core/process/configuration.h"
#include "tools/evaluate/paper_facts.h"
#include "tools/evaluate/paper_failures.h"
#include "tools/evaluate/paper_figures.h"
#include "tools/evaluate/paper_rule.h"
#include "tools/evaluate/paper_summary.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/evaluate/scored_overlay.h"
#include "tools/evaluate/shard.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <set>

namespace goalmouth {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double centimetres(const std::optional<ErrorStatistics>& distance, double ErrorStatistics::*value) {
    return distance ? 100.0 * (*distance).*value : nothing;
}

Cell percent(const Summary& summary) {
    return Cell(summary.posts > 0 ? 100.0 * summary.detection_rate() : nothing, 1);
}

/// Calls f for each detector in each scene, scene by scene.
template <class F>
void for_each_pair(const PaperResult& result, F f) {
    for (std::size_t s = 0; s < result.scenes.size(); ++s)
        for (std::size_t d = 0; d < result.detectors.size(); ++d) f(d, s);
}

std::string title_of(const PaperResult& result, std::size_t detector, std::size_t scene) {
    return result.detectors[detector] + ", scene " + result.scenes[scene];
}

/// "histogram, scene flat: found 81.2 % of 6180 posts, with 0.31 false posts a frame; its distances are …"
std::string sentence_of(const PaperResult& result, const RecordTable& table, std::size_t detector,
                        std::size_t scene) {
    int posts = 0;
    int detected = 0;
    int frames = 0;
    int false_posts = 0;
    std::string errors;
    for (std::size_t t = 0; t < cell_tilts_deg.size(); ++t) {
        const Summary tilt = table.tilt(detector, scene, t);
        posts += tilt.posts;
        detected += tilt.detected;
        frames += tilt.frames;
        false_posts += tilt.false_posts;
        const double rmse = centimetres(tilt.in_line.distance, &ErrorStatistics::rmse);
        errors += (t > 0 ? " / " : "") + (std::isfinite(rmse) ? fmt::format("{:.1f}", rmse) : "–");
    }
    if (frames == 0) return title_of(result, detector, scene) + ": no frame was done.";
    std::string text = fmt::format(
        "{}: {:.1f} % of {} posts found, {:.3f} false posts a frame; RMSE of the distance {} cm at 0 / 10 / "
        "20° "
        "of tilt",
        title_of(result, detector, scene), posts > 0 ? 100.0 * detected / posts : 0.0, posts,
        static_cast<double>(false_posts) / frames, errors);
    const auto paper = paper_figures(result.detectors[detector]);
    if (paper && paper->rmse_cm.front() && paper->rmse_cm.back())
        text += fmt::format(" (paper, its own photographs: {} cm at 0° to {} cm at 20°, detection {})",
                            *paper->rmse_cm.front(), *paper->rmse_cm.back(), paper->detection);
    return text + ".";
}

Table tilt_table(const PaperResult& result, const RecordTable& table) {
    Table t;
    t.caption = "By tilt, all six distances together";
    t.columns = {"detector", "scene",   "tilt °",        "frames",      "detected %", "false posts a frame",
                 "RMSE cm",  "bias cm", "median |e| cm", "95 % |e| cm", "measured",   "paper's RMSE cm"};
    t.groups = {{"", 4}, {"detection", 2}, {"distance of the post in line", 5}, {"paper", 1}};
    for_each_pair(result, [&](std::size_t d, std::size_t s) {
        const auto paper = paper_figures(result.detectors[d]);
        for (std::size_t i = 0; i < cell_tilts_deg.size(); ++i) {
            const Summary tilt = table.tilt(d, s, i);
            const auto& distance = tilt.in_line.distance;
            t.rows.push_back({result.detectors[d], result.scenes[s], Cell(cell_tilts_deg[i], 0),
                              Cell(tilt.frames, 0), percent(tilt), Cell(tilt.false_per_frame(), 3),
                              Cell(centimetres(distance, &ErrorStatistics::rmse), 2, Cell::Mark::strong),
                              Cell(centimetres(distance, &ErrorStatistics::bias), 2),
                              Cell(centimetres(distance, &ErrorStatistics::median_abs), 2),
                              Cell(centimetres(distance, &ErrorStatistics::p95_abs), 2),
                              Cell(tilt.in_line.measured, 0),
                              Cell(paper ? paper->rmse_cm[i].value_or(nothing) : nothing, 2)});
        }
    });
    return t;
}

Table cell_table(const PaperResult& result, const RecordTable& table, std::size_t detector,
                 std::size_t scene) {
    Table t;
    t.caption = title_of(result, detector, scene) + ": each distance and tilt";
    t.columns = {"distance cm",   "tilt °",
                 "frames",        "posts",
                 "detected %",    "false posts",
                 "RMSE cm",       "bias cm",
                 "σ cm",          "median |e| cm",
                 "95 % |e| cm",   "left edge px",
                 "right edge px", "bearing RMSE mrad",
                 "measured",      "bias cm",
                 "RMSE cm"};
    t.groups = {{"", 4}, {"detection", 2}, {"post in line", 9}, {"other post", 2}};
    for (int c = 0; c < cell_count; ++c) {
        const Summary cell = table.cell(detector, scene, c);
        const auto& distance = cell.in_line.distance;
        const auto edge = [&](std::size_t side) {
            return Cell(cell.in_line.edges ? (*cell.in_line.edges)[side] : nothing, 2);
        };
        t.rows.push_back({Cell(evaluation_cell(c).distance_cm, 0), Cell(evaluation_cell(c).tilt_deg, 0),
                          Cell(cell.frames, 0), Cell(cell.posts, 0), percent(cell), Cell(cell.false_posts, 0),
                          Cell(centimetres(distance, &ErrorStatistics::rmse), 2, Cell::Mark::strong),
                          Cell(centimetres(distance, &ErrorStatistics::bias), 2),
                          Cell(centimetres(distance, &ErrorStatistics::sigma), 2),
                          Cell(centimetres(distance, &ErrorStatistics::median_abs), 2),
                          Cell(centimetres(distance, &ErrorStatistics::p95_abs), 2), edge(0), edge(1),
                          Cell(1000.0 * cell.in_line.bearing_rmse.value_or(nothing), 2),
                          Cell(cell.in_line.measured, 0),
                          Cell(centimetres(cell.second.distance, &ErrorStatistics::bias), 2),
                          Cell(centimetres(cell.second.distance, &ErrorStatistics::rmse), 2)});
    }
    return t;
}

std::vector<std::pair<std::string, std::string>> rule_entries() {
    std::vector<std::pair<std::string, std::string>> entries;
    const nlohmann::ordered_json rule = paper_rule();
    for (const auto& [name, value] : rule.items())
        entries.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
    return entries;
}

/// File names of the figures of each detector in each scene: "ransac-flat".
class FigureNames {
  public:
    std::string of(const PaperResult& result, std::size_t detector, std::size_t scene) {
        std::string name = result.detectors[detector] + "-" + result.scenes[scene];
        for (char& c : name) {
            const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
            if (!plain && c != '-' && c != '_') c = '_';
        }
        const std::string wanted = name;
        for (int n = 2; !taken_.insert(name).second; ++n) name = fmt::format("{}-{}", wanted, n);
        return name;
    }

  private:
    std::set<std::string> taken_;
};

void add_figures(HtmlPage& page, const PaperResult& result, const RecordTable& table,
                 const std::filesystem::path& folder) {
    FigureNames names;
    for_each_pair(result, [&](std::size_t d, std::size_t s) {
        const std::string stem = names.of(result, d, s);
        page.figures({draw_figure(detection_figure(result, table, d, s), folder, "detection-" + stem),
                      draw_figure(distance_figure(result, table, d, s), folder, "distance-" + stem)},
                     title_of(result, d, s) +
                         ": posts found, and estimated over true distance (mean ± standard deviation; the "
                         "diagonal is the truth).");
    });
}

/// The setup to render failures with: the run's own, or one made anew where that is the same.
std::optional<PaperSetup> remade(const PaperResult& result) {
    try {
        PaperSetup setup = set_up_paper(result.options);
        if (setup.settings == result.settings) return setup;
    } catch (const ConfigurationError&) {
    }
    return std::nullopt;
}

void add_failures(HtmlPage& page, const PaperResult& result, const PaperSetup& setup) {
    page.paragraph(std::string("The largest errors of distance, missed posts (the nearest first) and false "
                               "posts, rendered once more from their numbers. ") +
                   scored_legend);
    for_each_pair(result, [&](std::size_t d, std::size_t s) {
        const std::vector<PagePicture> pictures = failure_pictures(result, setup, d, s);
        if (pictures.empty()) return;
        page.subsection(title_of(result, d, s));
        page.pictures(pictures);
    });
}

}  // namespace

void write_paper_report(const PaperResult& result, const PaperSetup* setup,
                        const std::filesystem::path& target) {
    ReportFolder folder(target);
    const RecordTable table(result.records, result.scenes.size());
    HtmlPage page(
        "Goalpost detection and distance, as in the paper",
        "Six distances and three tilts of the body, in line with the right post, on rendered frames "
        "whose truth the detectors cannot see.");
    if (!result.complete)
        page.note(fmt::format("Not the whole: {} frames were done, the others are missing.",
                              result.records.size()));
    if (result.shard) page.note("This is shard " + shard_text(*result.shard) + " of a larger run.");

    page.section("Summary");
    std::vector<std::string> sentences;
    for_each_pair(
        result, [&](std::size_t d, std::size_t s) { sentences.push_back(sentence_of(result, table, d, s)); });
    page.list(sentences);
    page.table(tilt_table(result, table));

    page.section("Figures");
    add_figures(page, result, table, folder.path());

    page.section("Each distance and tilt");
    for_each_pair(result, [&](std::size_t d, std::size_t s) { page.table(cell_table(result, table, d, s)); });

    page.section("Worst failures");
    const std::optional<PaperSetup> again = setup == nullptr ? remade(result) : std::nullopt;
    if (setup == nullptr && again) setup = &*again;
    if (setup != nullptr)
        add_failures(page, result, *setup);
    else
        page.note("No pictures: the configuration here is no longer the one this was run with.");

    page.section("How it was made");
    page.code(result.command);
    page.definitions(
        {{"goalmouth", result.version},
         {"seed", std::to_string(result.options.seed)},
         {"frames", fmt::format("{} in each of {} cells and {} scenes", result.options.frames_per_cell,
                                cell_count, result.scenes.size())},
         {"paper", paper_source}});
    page.paragraph(
        "The same command gives the same numbers, bit for bit, whatever --jobs is. What the scenes hold, and "
        "where each of their numbers comes from, stands in config/scenes and config/evaluation; they were "
        "set before any detector was run on them.");
    page.details("What each number means", [](HtmlPage& inside) { inside.definitions(rule_entries()); });
    page.details("Every setting", [&](HtmlPage& inside) { inside.code(result.settings.dump(1)); });
    folder.write("index.html", page.html());
    folder.publish();
}

}  // namespace goalmouth
