#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/images_report.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>
#include <optional>

namespace goalmouth {
namespace {

constexpr double cm = 100.0;  // in a metre

/// Width of the first column.
std::size_t widest_set(const ImagesResult& result) {
    std::size_t widest = 4;
    for (const ImageSetResult& set : result.sets) widest = std::max(widest, set.set.size());
    return widest;
}

std::string score_text(const ImagesResult& result) {
    const std::size_t widest = widest_set(result);
    std::string text =
        fmt::format("{:<{}}  {:<12} {:>5} {:>6} {:>7} {:>6} {:>8} {:>10} {:>13}\n", "set", widest, "detector",
                    "posts", "found", "missed", "wrong", "recall", "precision", "on negatives");
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : result.options.detectors) {
            const ImageScore s = set.score(detector);
            text +=
                fmt::format("{:<{}}  {:<12} {:>5} {:>6} {:>7} {:>6} {:>6.1f} % {:>8.1f} % {:>6} in {:>3}\n",
                            set.set, widest, graph_name(detector), s.posts, s.found, s.missed(), s.wrong,
                            100.0 * s.recall(), 100.0 * s.precision(), s.wrong_on_negatives, s.negatives);
        }
    }
    return text;
}

std::string errors_text(const std::optional<ErrorStatistics>& e) {
    if (!e) return fmt::format(" {:>20}", "-");
    return fmt::format("  {:>6.2f} {:>6.2f} {:>5.2f}", e->bias, e->rmse, e->median_abs);
}

std::string edges_text(const ImagesResult& result) {
    const std::size_t widest = widest_set(result);
    std::string rows;
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : result.options.detectors) {
            for (const MeasuredGroup& group : groups(set.measured(detector))) {
                const EdgeSummary s = edge_summary(group.posts);
                rows += fmt::format("{:<{}}  {:<12} {:<11} {:>5}{}{}{}  {:>5}\n", set.set, widest,
                                    graph_name(detector), group.name, s.posts, errors_text(s.left),
                                    errors_text(s.right), errors_text(s.width),
                                    s.annotation_sigma ? fmt::format("{:.2f}", *s.annotation_sigma) : "-");
            }
        }
    }
    if (rows.empty()) return rows;
    return fmt::format(
               "\nEdges at 1/4, 1/2 and 3/4 of the outlines' length, detected less outlined [px]: mean, rms, "
               "median of the size\n"
               "{:<{}}  {:<12} {:<11} {:>5}  {:^19}  {:^19}  {:^19}  {:>5}\n",
               "set", widest, "detector", "of", "posts", "left", "right", "width", "own σ") +
           rows;
}

std::string distance_row(const std::string& range, const DistanceSummary& s) {
    return fmt::format("{:<11} {:>5} {:>7.1f} cm {:>7.1f} cm {:>7.1f} % {:>6.1f} %{}\n", range, s.posts,
                       cm * s.errors.rmse, cm * s.errors.bias, 100.0 * s.relative_rms,
                       100.0 * s.median_relative,
                       s.without > 0 ? fmt::format("  ({} more without)", s.without) : "");
}

std::string distances_text(const ImagesResult& result) {
    const std::size_t widest = widest_set(result);
    std::string text;
    for (const ImageSetResult& set : result.sets) {
        if (!set.goals || set.pictures.empty()) continue;
        const PlacementSummary placed = placement_summary(set.of(result.options.detectors.front()));
        text += fmt::format(
            "\nDistances, {}: field {}, posts {:g} cm thick; {} of {} outlined posts are in the direction of "
            "a goalpost, by {:.1f} deg rms\n"
            "{:<{}}  {:<12} {:<11} {:<11} {:>5} {:>10} {:>10} {:>9} {:>8}\n",
            set.set, set.goals->name, cm * set.goals->post_diameter, placed.posts - placed.unplaced,
            placed.posts, placed.direction_rms * 180.0 / std::numbers::pi, "set", widest, "detector", "of",
            "true, m", "posts", "RMSE", "bias", "rel. rms", "median");
        for (const DistanceGroup& group : set.distances(result.options.detectors)) {
            const auto whole = distance_summary(group.samples);
            if (!whole) continue;
            const std::string start =
                fmt::format("{:<{}}  {:<12} {:<11} ", set.set, widest,
                            group.detector.empty() ? "(outlines)" : graph_name(group.detector), group.of);
            for (const DistanceSummary& s : by_distance(group.samples))
                text += start + distance_row(fmt::format("{:g} to {:g}", s.from, s.to), s);
            text += start + distance_row("all", *whole);
        }
    }
    return text;
}

}  // namespace

std::string images_text(const ImagesResult& result) {
    return score_text(result) + edges_text(result) + distances_text(result);
}

}  // namespace goalmouth
