#include "tests/bench/bench_report.h"

#include "core/detection/ransac_parameters.h"
#include "tests/bench/bench_figures.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"

#include <fmt/format.h>
#include <sstream>

namespace goalmouth::bench {
namespace {

using Mark = Cell::Mark;
using Kind = StageRow::Kind;

Table ratio_table(const std::vector<Ratio>& ratios) {
    Table table;
    table.caption = "Ratios of medians, measured in one run";
    table.columns = {"", "ours", "other", "which", "ratio", "bar", "stretch", "verdict"};
    table.good = "the bar is met";
    table.bad = "it is not";
    for (const Ratio& r : ratios) {
        table.rows.push_back({r.name, r.measured ? value_text(r, r.ours_ms) : std::string("-"),
                              r.measured ? value_text(r, r.other_ms) : std::string("-"), r.other,
                              r.measured ? Cell(r.ratio, 3, r.met() ? Mark::good : Mark::bad) : Cell("-"),
                              fmt::format("≤ {:g}", r.bar), fmt::format("{:g}", r.stretch), verdict_text(r)});
    }
    return table;
}

Table stage_table(const SizeResult& size) {
    Table table;
    table.caption = "Times of one frame [ms], one thread";
    table.columns = {
        "", "median", "25 %", "75 %", "95 %", "least", "posts' edges seen [%]", "finds in a frame"};
    for (const StageRow& row : size.rows) {
        const Timing& t = row.timing;
        std::string label = (row.kind == Kind::part ? "of it " : "") + t.label;
        if (row.spacing != 0 && row.kind != Kind::part) label += fmt::format(", every {} px", row.spacing);
        const Mark mark = row.kind == Kind::ours ? Mark::strong : Mark::none;
        table.rows.push_back(
            {label, Cell(t.median, 3, mark), Cell(t.p25, 3), Cell(t.p75, 3), Cell(t.p95, 3), Cell(t.least, 3),
             row.edges_seen ? Cell(100.0 * *row.edges_seen, 0) : Cell(""),
             row.finds.empty() ? std::string()
                               : fmt::format("{:.{}f} {}", row.found, row.found < 100.0 ? 1 : 0, row.finds)});
    }
    return table;
}

Table refinement_table(const RefinementRow& row) {
    Table table;
    table.caption = "Times of one post [ms], one thread: " + refinement_words(row);
    table.columns = {"", "median", "25 %", "75 %", "95 %", "least"};
    for (const Timing* t : {&row.ours, &row.full}) {
        const Mark mark = t == &row.ours ? Mark::strong : Mark::none;
        table.rows.push_back({t->label, Cell(t->median, 3, mark), Cell(t->p25, 3), Cell(t->p75, 3),
                              Cell(t->p95, 3), Cell(t->least, 3)});
    }
    return table;
}

Table point_table(const std::vector<PointRow>& points) {
    Table table;
    table.caption =
        fmt::format("One search for up to three lines [µs], {} hypotheses each", RansacParameters{}.attempts);
    table.columns = {"points", "ours", "25 %", "75 %", "literal", "25 %", "75 %", "ratio", "same consensus"};
    for (const PointRow& row : points) {
        table.rows.push_back({std::to_string(row.points), Cell(1e3 * row.ours.median, 2, Mark::strong),
                              Cell(1e3 * row.ours.p25, 2), Cell(1e3 * row.ours.p75, 2),
                              Cell(1e3 * row.literal.median, 2), Cell(1e3 * row.literal.p25, 2),
                              Cell(1e3 * row.literal.p75, 2), Cell(row.ratio(), 3),
                              row.same_consensus ? "yes" : "NO"});
    }
    return table;
}

std::vector<std::pair<std::string, std::string>> settings_of(const SizeResult& size) {
    std::vector<std::pair<std::string, std::string>> entries;
    for (const StageRow& row : size.rows)
        if (!row.settings.empty() && (row.spacing == 0 || row.spacing == judged_spacing))
            entries.emplace_back(row.timing.label, row.settings);
    return entries;
}

void add_stages(HtmlPage& page, const StagesResult& stages, const std::filesystem::path& folder) {
    if (!stages.sound())
        page.note("A fast version and its plain one disagree: the figures below mean nothing.");
    page.section("Stages");
    page.paragraph(
        "Ours and what people would use instead took turns on the same frames, a few frames at a time, in "
        "one "
        "thread. The frames lie in more memory than the last-level cache holds and are visited in one order "
        "by "
        "all, so every frame is cold. Parts of the chain are timed inside it.");
    for (const SizeResult& size : stages.sizes) {
        const std::string name = fmt::format("{}x{}", size.size.width, size.size.height);
        page.subsection(fmt::format("{}×{}", size.size.width, size.size.height));
        page.paragraph(
            fmt::format("{} frames ({} different), {:.0f} MB, {}; {} edges of posts are in the different "
                        "ones.",
                        size.frames, size.different, 1e-6 * static_cast<double>(size.bytes), size.source,
                        size.true_edges));
        page.figure(draw_figure(contenders_figure(size), folder, "contenders-" + name),
                    "On a logarithmic scale.");
        page.table(stage_table(size));
        if (size.refinement && size.refinement->measured()) page.table(refinement_table(*size.refinement));
        page.details("What each one is", [&](HtmlPage& inside) { inside.definitions(settings_of(size)); });
    }
    for (const std::string& words : stages.left_out) page.paragraph("Not among them: " + words + ".");
    page.section("How it grows");
    std::vector<DrawnFigure> drawn;
    for (const SizeResult& size : stages.sizes)
        drawn.push_back(draw_figure(spacing_figure(size), folder,
                                    fmt::format("spacing-{}x{}", size.size.width, size.size.height)));
    page.figures(
        drawn,
        "Medians with quartiles. Vertical scan-lines up to 32 px apart touch every cache line of the "
        "frame, so the floor is the same for all spacings.");
    page.figure(draw_figure(points_figure(stages.points), folder, "points"),
                "Medians with quartiles, on logarithmic scales.");
    page.table(point_table(stages.points));
}

}  // namespace

void write_bench_report(const BenchResult& result, const std::filesystem::path& target) {
    ReportFolder folder(target);
    HtmlPage page("What frames cost",
                  "Our stages beside what people would use instead, on the same frames in the same run.");
    const std::vector<Ratio> ratios = result.ratios();
    if (!ratios.empty()) {
        page.section("Promised, and measured");
        page.table(ratio_table(ratios));
        if (result.stages) {
            const SizeResult& at = result.stages->largest();
            page.paragraph(
                fmt::format("The stages' rows are those of {}×{}, scan-lines every {} px both ways.",
                            at.size.width, at.size.height, judged_spacing));
        }
    }
    if (result.stages) add_stages(page, *result.stages, folder.path());
    if (result.graph) {
        page.section("The graph of processes");
        if (const Figure figure = latency_figure(*result.graph); !figure.series.empty())
            page.figure(draw_figure(figure, folder.path(), "latency"),
                        "Share of the frames whose posts were in a listener's hand by that age, on a "
                        "logarithmic scale.");
        std::ostringstream text;
        result.graph->print(text);
        page.code(text.str());
    }
    page.section("How it was made");
    page.code(result.command);
    std::vector<std::pair<std::string, std::string>> entries = {
        {"machine", fmt::format("{}, {} processors, last-level cache {} MiB", result.machine.processor,
                                result.machine.processors, result.machine.last_level_cache >> 20)},
        {"system", result.machine.system},
        {"SIMD", fmt::format("ours {}; OpenCV {}", result.machine.simd, result.machine.opencv_features)},
        {"compiler", result.machine.compiler},
        {"seed", std::to_string(result.options.seed)}};
    entries.insert(entries.end(), result.machine.versions.begin(), result.machine.versions.end());
    page.definitions(entries);
    folder.write("index.html", page.html());
    folder.publish();
}

}  // namespace goalmouth::bench
