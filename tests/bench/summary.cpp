#include "tests/bench/summary.h"

#include "core/detection/ransac_parameters.h"
#include "tools/goalmouth/bench_options.h"

#include <fmt/format.h>
#include <iterator>

namespace goalmouth::bench {
namespace {

using Kind = StageRow::Kind;

/// Three or four digits that mean something.
std::string digits(double ms) {
    return fmt::format("{:.{}f}", ms, ms < 0.1 ? 4 : ms < 10.0 ? 3 : 2);
}

std::string ms_text(double ms) {
    return digits(ms) + " ms";
}

const char* heading(Kind kind) {
    switch (kind) {
        case Kind::ours:
        case Kind::part:
            return "ours";
        case Kind::plain:
            return "our plain versions";
        case Kind::floor:
            return "the floor";
        case Kind::other:
            return "what people use instead";
    }
    return "";
}

std::string found_text(const StageRow& row) {
    if (row.finds.empty()) return {};
    std::string text = fmt::format("{:.{}f} {}", row.found, row.found < 100.0 ? 1 : 0, row.finds);
    if (row.edges_seen) text += fmt::format("; {:.0f} % of the posts' edges", 100.0 * *row.edges_seen);
    return text;
}

std::string row_text(const StageRow& row) {
    const Timing& t = row.timing;
    std::string label = (row.kind == Kind::part ? "  of it " : "") + t.label;
    if (row.spacing != 0 && row.kind != Kind::part) label += fmt::format(", every {} px", row.spacing);
    return fmt::format("    {:<33} {:>9} {:>9} {:>9} {:>9}   {}\n", label, digits(t.median), digits(t.least),
                       digits(t.p25), digits(t.p75), found_text(row));
}

}  // namespace

std::vector<Ratio> BenchResult::ratios() const {
    std::vector<Ratio> all;
    if (stages) all = stage_ratios(*stages);
    if (graph) {
        const std::vector<Ratio> more = graph->ratios();
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

std::string head_text(const BenchResult& result) {
    const Machine& m = result.machine;
    std::string text = fmt::format(
        "goalmouth bench\n  machine   {}, {} processors, last-level cache {} MiB\n  system    {}\n"
        "  SIMD      ours {}; OpenCV {}\n  compiler  {}\n  versions  ",
        m.processor, m.processors, m.last_level_cache >> 20, m.system, m.simd, m.opencv_features, m.compiler);
    for (std::size_t i = 0; i < m.versions.size(); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", m.versions[i].first, m.versions[i].second);
    return text + "\n";
}

std::string size_text(const SizeResult& size) {
    std::string text = fmt::format(
        "\n{}×{}: {} frames ({} different), {:.0f} MB, {}; one thread, medians over frames [ms]{}\n"
        "    {:<33} {:>9} {:>9} {:>9} {:>9}   finds in a frame\n",
        size.size.width, size.size.height, size.frames, size.different,
        1e-6 * static_cast<double>(size.bytes), size.source,
        size.frames < static_cast<std::size_t>(least_frames) ? "; " + not_cold_words() : "", "", "median",
        "least", "25 %", "75 %");
    for (const Kind kind : {Kind::ours, Kind::plain, Kind::floor, Kind::other}) {
        text += fmt::format("  {}\n", heading(kind));
        for (const StageRow& row : size.rows)
            if (row.kind == kind || (kind == Kind::ours && row.kind == Kind::part)) text += row_text(row);
    }
    return text;
}

std::string refinement_text(const SizeResult& size) {
    if (!size.refinement) return {};
    const RefinementRow& row = *size.refinement;
    std::string text = fmt::format("  refinement of a post that RANSAC found, medians over posts [ms]: {}\n",
                                   refinement_words(row));
    if (!row.measured()) return text;
    for (const Timing* t : {&row.ours, &row.full})
        text += fmt::format("    {:<33} {:>9} {:>9} {:>9} {:>9}\n", t->label, digits(t->median),
                            digits(t->least), digits(t->p25), digits(t->p75));
    return text;
}

std::string left_out_text(const StagesResult& stages) {
    std::string text;
    for (const std::string& words : stages.left_out) text += "\nNot among them: " + words + "\n";
    return text;
}

std::string points_text(const std::vector<PointRow>& points) {
    if (points.empty()) return {};
    std::string text =
        fmt::format("\nRANSAC, k = {}: medians over sets [µs]\n    {:>6} {:>10} {:>10} {:>8}\n",
                    RansacParameters{}.attempts, "points", "ours", "literal", "ratio");
    for (const PointRow& row : points) {
        text += fmt::format("    {:>6} {:>10.2f} {:>10.2f} {:>8.3f}   {}\n", row.points,
                            1e3 * row.ours.median, 1e3 * row.literal.median, row.ratio(),
                            row.same_consensus ? "same consensus" : "NOT THE SAME CONSENSUS");
    }
    return text;
}

std::string value_text(const Ratio& ratio, double value) {
    return ratio.unit.empty() ? ms_text(value) : fmt::format("{:g} {}", value, ratio.unit);
}

std::string verdict_text(const Ratio& ratio) {
    if (!ratio.measured) return "not measured";
    const std::string scope = ratio.scope.empty() ? "" : " " + ratio.scope;
    if (!ratio.met()) return "NOT MET" + scope;
    return (ratio.stretch_met() ? "met, stretch too" : "met") + scope;
}

std::string ratios_text(const std::vector<Ratio>& ratios) {
    if (ratios.empty()) return {};
    const std::string conditions = conditions_text(ratios);
    std::string text = fmt::format("\n{}{}\n{:<50} {:>11} {:>11} {:>8} {:>7} {:>8}\n",
                                   "Promised, and measured", conditions.empty() ? "" : ": " + conditions, "",
                                   "ours", "other", "ratio", "bar", "stretch");
    for (const Ratio& r : ratios) {
        const std::string ratio = r.measured ? fmt::format("{:.3f}", r.ratio) : "-";
        text += fmt::format("{:<50} {:>11} {:>11} {:>8} {:>7g} {:>8g}  {}\n", r.name,
                            r.measured ? value_text(r, r.ours_ms) : "-",
                            r.measured ? value_text(r, r.other_ms) : "-", ratio, r.bar, r.stretch,
                            verdict_text(r));
    }
    for (const Ratio& r : ratios)
        if (!r.note.empty()) text += fmt::format("  {}: {}\n", r.name, r.note);
    return text;
}

std::string conditions_text(const std::vector<Ratio>& ratios) {
    for (const Ratio& r : ratios)
        if (!r.size.empty() && r.spacing > 0)
            return fmt::format("{}, scan-lines every {} px", r.size, r.spacing);
    return {};
}

}  // namespace goalmouth::bench
