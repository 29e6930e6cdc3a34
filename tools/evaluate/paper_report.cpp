#include "tools/evaluate/paper_report.h"

#include "core/evaluation/cell.h"
#include "core/process/configuration.h"
#include "tools/evaluate/paper_acceptance.h"
#include "tools/evaluate/paper_facts.h"
#include "tools/evaluate/paper_failures.h"
#include "tools/evaluate/paper_figures.h"
#include "tools/evaluate/paper_headline.h"
#include "tools/evaluate/paper_rule.h"
#include "tools/evaluate/paper_settings.h"
#include "tools/evaluate/paper_summary.h"
#include "tools/evaluate/paper_tables.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/evaluate/scored_overlay.h"
#include "tools/evaluate/shard.h"

#include <fmt/format.h>
#include <optional>
#include <set>

namespace goalmouth {
namespace {

std::string title_of(const PaperResult& result, std::size_t detector, std::size_t scene) {
    return result.detectors[detector] + ", scene " + result.scenes[scene];
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
    page.paragraph(
        "Left: posts found. Right: estimated over true distance, mean ± standard deviation; the dashed "
        "diagonal is the truth. " +
        std::string(dodge_words));
    FigureNames names;
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        if (result.scenes.size() > 1) page.subsection("Scene " + result.scenes[s]);
        for (std::size_t d = 0; d < result.detectors.size(); ++d) {
            const std::string stem = names.of(result, d, s);
            page.figures({draw_figure(detection_figure(result, table, d, s), folder, "detection-" + stem),
                          draw_figure(distance_figure(result, table, d, s), folder, "distance-" + stem)},
                         "");
        }
    }
}

void add_bounds(HtmlPage& page, const PaperResult& result, const RecordTable& table,
                const std::filesystem::path& folder) {
    page.paragraph(
        "How well the post's two edges can tell its distance at all, by Cramér and Rao, against what was "
        "reached: full lines are the RMSE, dashed ones the bound. Of a chain that refines, the RMSE is that "
        "of "
        "the frames it calls good.");
    std::vector<std::string> asked;
    for (const AcceptanceLine& line : paper_acceptance(result, table)) asked.push_back(line.text());
    if (!asked.empty()) page.list(asked);
    FigureNames names;
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        std::vector<DrawnFigure> figures;
        for (std::size_t d = 0; d < result.detectors.size(); ++d)
            figures.push_back(
                draw_figure(bound_figure(result, table, d, s), folder, "bound-" + names.of(result, d, s)));
        if (result.scenes.size() > 1) page.subsection("Against the bound, scene " + result.scenes[s]);
        page.figures(figures, "");
        page.details("Every distance and tilt against the bound, scene " + result.scenes[s],
                     [&](HtmlPage& inside) {
                         for (std::size_t d = 0; d < result.detectors.size(); ++d)
                             inside.table(bound_table(result, table, d, s));
                     });
    }
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
    page.paragraph(
        "Of each detector in each scene the two frames with the largest errors of distance, two with missed "
        "posts (the nearest first) and two with the most false posts, rendered once more from their numbers. "
        "A click on a picture shows it large, another one closes it.");
    page.paragraph(scored_legend);
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        for (std::size_t d = 0; d < result.detectors.size(); ++d) {
            const std::vector<PagePicture> pictures = failure_pictures(result, setup, d, s);
            if (pictures.empty()) continue;
            page.subsection(title_of(result, d, s));
            page.pictures(pictures);
        }
    }
}

}  // namespace

void write_paper_report(const PaperResult& result, const PaperSetup* setup,
                        const std::filesystem::path& target) {
    ReportFolder folder(target);
    const RecordTable table(result.records, result.scenes.size(),
                            refining_detectors(result.settings, result.detectors));
    HtmlPage page(
        "Goalpost detection and distance, as in the paper",
        "Six distances and three tilts of the body, in line with the right post, on rendered frames "
        "whose truth the detectors cannot see.");
    if (!result.complete)
        page.note(fmt::format("Not the whole: {} frames were done, the others are missing.",
                              result.records.size()));
    if (result.shard) page.note("This is shard " + shard_text(*result.shard) + " of a larger run.");

    page.section("Summary");
    for (const std::string& text : paper_headline(result, table)) page.paragraph(text);
    page.table(overview_table(result, table));
    page.details("Every tilt, with bias, median and 95th percentile",
                 [&](HtmlPage& inside) { inside.table(tilt_table(result, table)); });

    page.section("Figures");
    add_figures(page, result, table, folder.path());

    page.section("Against the bound");
    add_bounds(page, result, table, folder.path());

    page.section("Each distance and tilt");
    page.paragraph(
        "Distance, edges and bearing are those of the post in line; the edges' means are positive to the "
        "right.");
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        page.details("Scene " + result.scenes[s], [&](HtmlPage& inside) {
            for (std::size_t d = 0; d < result.detectors.size(); ++d)
                inside.table(cell_table(result, table, d, s));
        });
    }

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
