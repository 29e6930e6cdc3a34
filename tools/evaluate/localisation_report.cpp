#include "tools/evaluate/localisation_report.h"

#include "tools/evaluate/localisation_figures.h"
#include "tools/evaluate/localisation_summary.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"

#include <fmt/format.h>
#include <utility>
#include <vector>

namespace goalmouth {
namespace {

constexpr double cm = 100.0;  // in a metre

Cell position(const MeanSigma& m) {
    return Cell::with_deviation(cm * m.mean, cm * m.sigma, 1);
}

Cell heading(const MeanSigma& m) {
    return Cell::with_deviation(m.mean, m.sigma, 3);
}

Table quality_table(const std::vector<DetectorSummary>& summaries, const std::string& caption,
                    QualitySummary DetectorSummary::*part) {
    Table table;
    table.caption = caption;
    table.columns = {"detector", "mean ± σ", "median", "mean ± σ", "median", "position", "heading"};
    table.groups = {
        {"", 1}, {"position error [cm]", 2}, {"heading error [rad]", 2}, {"the filter's own σ [cm, rad]", 2}};
    for (const DetectorSummary& s : summaries) {
        const QualitySummary& q = s.*part;
        table.rows.push_back({s.detector, position(q.position_error), Cell(cm * q.position_median, 1),
                              heading(q.heading_error), Cell(q.heading_median, 3), position(q.position_sigma),
                              heading(q.heading_sigma)});
    }
    return table;
}

Table paper_table() {
    const PaperLocalisation paper;
    Table table;
    table.caption = "The paper's figures; it calls them uncertainty and does not say of what";
    table.columns = {"detector", "position [cm]", "heading [rad]"};
    table.rows = {{"histogram", position(paper.histogram_position),
                   Cell::with_deviation(paper.histogram_heading.mean, paper.histogram_heading.sigma, 2)},
                  {"ransac", position(paper.ransac_position),
                   Cell::with_deviation(paper.ransac_heading.mean, paper.ransac_heading.sigma, 2)}};
    return table;
}

struct NamedReduction {
    const char* name;
    Reduction DetectorComparison::*value;
    bool of_position;
};

constexpr NamedReduction reductions[] = {
    {"position error, whole walk", &DetectorComparison::walk_position_error, true},
    {"position error, last second", &DetectorComparison::end_position_error, true},
    {"the filter's σ of position, whole walk", &DetectorComparison::walk_position_sigma, true},
    {"the filter's σ of position, last second", &DetectorComparison::end_position_sigma, true},
    {"heading error, whole walk", &DetectorComparison::walk_heading_error, false},
    {"heading error, last second", &DetectorComparison::end_heading_error, false},
    {"the filter's σ of heading, whole walk", &DetectorComparison::walk_heading_sigma, false},
    {"the filter's σ of heading, last second", &DetectorComparison::end_heading_sigma, false}};

bool as_in_paper(const DetectorComparison& c) {
    return c.detector == "ransac" && c.against == "histogram";
}

double papers(const NamedReduction& r) {
    const PaperLocalisation paper;
    return r.of_position ? paper.position_reduction : paper.heading_reduction;
}

Table reduction_table(const DetectorComparison& c) {
    Table table;
    table.caption = c.detector + " against " + c.against + ": less by";
    table.columns = {"of the mean over runs", "reduction [%]", "95 % interval", "the paper [%]"};
    for (const NamedReduction& r : reductions) {
        const Reduction& value = c.*r.value;
        const std::string paper = !as_in_paper(c) ? "–"
                                  : r.of_position ? "18"
                                                  : "29 by its numbers, 34 as stated";
        const bool reached = value.value >= papers(r);
        const Cell::Mark mark = !as_in_paper(c) ? Cell::Mark::none
                                : reached       ? Cell::Mark::good
                                                : Cell::Mark::bad;
        table.rows.push_back({r.name, Cell(100.0 * value.value, 1, mark),
                              fmt::format("{:.1f} to {:.1f}", 100.0 * value.low, 100.0 * value.high), paper});
    }
    if (as_in_paper(c)) {
        table.good = "at least the paper's";
        table.bad = "less than the paper's";
    }
    return table;
}

/// By how much figures fall short of the paper's.
std::vector<std::string> verdicts(const DetectorComparison& c) {
    std::vector<std::string> sentences;
    for (const NamedReduction& r : reductions) {
        const double value = (c.*r.value).value;
        const double wanted = papers(r);
        if (value < wanted)
            sentences.push_back(
                fmt::format("{}: {:.1f} % falls short of the paper's {:.0f} % by {:.1f} points.", r.name,
                            100.0 * value, 100.0 * wanted, 100.0 * (wanted - value)));
    }
    if (sentences.empty()) sentences.emplace_back("None falls short of the paper's.");
    return sentences;
}

Table lost_table(const std::vector<DetectorSummary>& summaries) {
    Table table;
    table.caption = "Runs that end lost, and what the detectors found";
    table.columns = {"detector", "runs", fmt::format("end more than {:g} m off [%]", lost_beyond),
                     "posts per frame"};
    for (const DetectorSummary& s : summaries) {
        table.rows.push_back(
            {s.detector, Cell(s.runs, 0), Cell(100.0 * s.lost, 1), Cell(s.posts_per_frame, 2)});
    }
    return table;
}

std::string plus_minus(const MeanSigma& m, double factor, int decimals) {
    return fmt::format("{:.{}f} ± {:.{}f}", factor * m.mean, decimals, factor * m.sigma, decimals);
}

}  // namespace

std::string localisation_text(const LocalisationResult& result) {
    std::string text = fmt::format("{} of {} runs of {:.1f} s, scene {}, seed {}\n", result.done.size(),
                                   result.runs, result.seconds, result.scene, result.seed);
    text += fmt::format("{:<12} {:<12} {:>16} {:>16} {:>16} {:>16} {:>7}\n", "detector", "", "position [cm]",
                        "heading [rad]", "own σ [cm]", "own σ [rad]", "lost");
    for (const DetectorSummary& s : summarise(result)) {
        for (const auto& [name, q] : {std::pair{"whole walk", &s.walk}, std::pair{"last second", &s.end}}) {
            text += fmt::format("{:<12} {:<12} {:>16} {:>16} {:>16} {:>16}", s.detector, name,
                                plus_minus(q->position_error, cm, 1), plus_minus(q->heading_error, 1.0, 3),
                                plus_minus(q->position_sigma, cm, 1), plus_minus(q->heading_sigma, 1.0, 3));
            text += q == &s.end ? fmt::format(" {:>5.0f} %\n", 100.0 * s.lost) : "\n";
        }
    }
    for (const DetectorComparison& c : compare(result)) {
        text += fmt::format("\n{} against {}: less by [95 % interval]{}\n", c.detector, c.against,
                            as_in_paper(c) ? ", the paper" : "");
        for (const NamedReduction& r : reductions) {
            const Reduction& v = c.*r.value;
            text += fmt::format("{:<42} {:>6.1f} % [{:.1f} … {:.1f}]{}\n", r.name, 100.0 * v.value,
                                100.0 * v.low, 100.0 * v.high,
                                !as_in_paper(c) ? ""
                                : r.of_position ? "  18 %"
                                                : "  29 % by its numbers, 34 % as stated");
        }
    }
    return text;
}

void write_localisation_report(const LocalisationResult& result, const std::filesystem::path& target) {
    ReportFolder folder(target);
    const std::vector<DetectorSummary> summaries = summarise(result);
    HtmlPage page("Self-localisation by goalposts",
                  "The paper's walk from the side line to the ball, goalposts the only landmarks, with each "
                  "detector on the same frames.");
    page.code(result.command);
    if (!result.complete()) {
        page.note(fmt::format("Only {} of {} runs are in here.", result.done.size(), result.runs));
    }
    page.section("Results");
    page.table(
        quality_table(summaries, "Means over the whole walk, mean ± σ over runs", &DetectorSummary::walk));
    page.table(
        quality_table(summaries, "Means over the last second, mean ± σ over runs", &DetectorSummary::end));
    page.table(paper_table());
    page.table(lost_table(summaries));

    const std::vector<DetectorComparison> comparisons = compare(result);
    if (!comparisons.empty()) page.section("Reductions");
    for (const DetectorComparison& c : comparisons) {
        page.table(reduction_table(c));
        if (as_in_paper(c)) page.list(verdicts(c));
    }

    page.section("Paths");
    std::vector<DrawnFigure> paths;
    for (std::size_t d = 0; d < result.detectors.size(); ++d)
        paths.push_back(draw_figure(paths_figure(result, d), folder.path(), fmt::format("paths-{}", d)));
    page.figures(paths,
                 "The true walk, and where each run's localisation saw the robot. A path is broken where the "
                 "belief jumps.");

    page.section("Errors over time");
    page.figure(draw_figure(position_over_time(result), folder.path(), "position-over-time"),
                "Mean over runs with ± σ. Dashed: how far off the filter itself believes to be.");
    page.figure(draw_figure(heading_over_time(result), folder.path(), "heading-over-time"),
                "The same for the heading.");

    page.section("The end of each run");
    page.figures({draw_figure(ends_figure(result), folder.path(), "ends"),
                  draw_figure(end_distribution_figure(result), folder.path(), "distribution")},
                 "A mean hides runs in which the belief settled in a wrong place: they stand apart here.");

    page.section("How it was done");
    page.list(
        {fmt::format("{} runs of {:.1f} s at {:g} frames a second, scene {}, field {}, seed {}.",
                     result.done.size(), result.seconds, result.frames_per_second, result.scene,
                     result.field.name, result.seed),
         "Each run has its own odometry slip, camera bias, pixel noise and particles, which follow from the "
         "seed and the run's number. Every detector sees the same frames, odometry and kinematics.",
         "Error: distance and angle between the true pose and that of the heaviest hypothesis. The filter's "
         "own σ: root of the trace of the covariance of x and y, and of the variance of the heading.",
         "Intervals: bootstrap over runs, both detectors' figures of a run drawn together.",
         "goalmouth " + result.version});
    folder.write("index.html", page.html());
    folder.publish();
}

}  // namespace goalmouth
