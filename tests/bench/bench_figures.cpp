#include "tests/bench/bench_figures.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace goalmouth::bench {
namespace {

using Kind = StageRow::Kind;

void add_point(Series& series, double x, const Timing& timing, double scale = 1.0) {
    series.x.push_back(x);
    series.y.push_back(scale * timing.median);
    series.low.push_back(scale * timing.p25);
    series.high.push_back(scale * timing.p75);
}

std::string size_words(const SizeResult& size) {
    return fmt::format("{}×{}", size.size.width, size.size.height);
}

}  // namespace

Figure spacing_figure(const SizeResult& size) {
    Figure figure;
    figure.title = fmt::format("Cost over spacing, {}", size_words(size));
    figure.x_label = "from scan-line to scan-line [px]";
    figure.y_label = "one frame [ms]";
    figure.log_x = true;
    figure.x_range = {3.5, 18.5};
    figure.width = 560;
    figure.height = 400;
    for (const int spacing : spacings) figure.x_ticks.push_back({double(spacing), std::to_string(spacing)});
    const std::pair<const char*, const char*> curves[] = {{"segments", "scan + segments"},
                                                          {"frame_to_posts", "frame → posts"},
                                                          {"naive_segments", "naive scan-lines"}};
    double highest = 0.0;
    for (const auto& [name, label] : curves) {
        Series series;
        series.name = label;
        for (const int spacing : spacings) {
            const Timing& timing = size.row(fmt::format("{}_{}", name, spacing)).timing;
            add_point(series, spacing, timing);
            highest = std::max(highest, timing.p75);
        }
        figure.series.push_back(series);
    }
    Series floor;
    floor.name = "one read of the frame";
    floor.style = {.kind = SeriesStyle::Kind::line, .colour = SeriesStyle::neutral, .dashed = true};
    floor.x = {3.5, 18.5};
    floor.y = {size.median("read"), size.median("read")};
    figure.series.push_back(floor);
    figure.y_range = {0.0, 1.05 * highest};
    return figure;
}

Figure points_figure(const std::vector<PointRow>& points) {
    Figure figure;
    figure.title = "RANSAC over points";
    figure.x_label = "edge points in the set";
    figure.y_label = "one search for lines [µs]";
    figure.log_x = true;
    figure.log_y = true;
    figure.x_range = {40.0, 1250.0};
    Series ours;
    ours.name = "ours";
    Series literal;
    literal.name = "literal Algorithm 2";
    for (const PointRow& row : points) {
        const auto at = static_cast<double>(row.points);
        figure.x_ticks.push_back({at, std::to_string(row.points)});
        add_point(ours, at, row.ours, 1e3);
        add_point(literal, at, row.literal, 1e3);
    }
    figure.series = {ours, literal};
    return figure;
}

Figure contenders_figure(const SizeResult& size) {
    Figure figure;
    figure.title = fmt::format("One frame of {}, one thread", size_words(size));
    figure.x_label = "median [ms], with quartiles; each mark on the scale is ten times the one before";
    figure.log_x = true;
    std::vector<const StageRow*> rows;
    for (const StageRow& row : size.rows)
        if (row.kind != Kind::part && (row.spacing == 0 || row.spacing == judged_spacing))
            rows.push_back(&row);
    std::sort(rows.begin(), rows.end(),
              [](const StageRow* a, const StageRow* b) { return a->timing.median > b->timing.median; });
    const std::pair<Kind, const char*> groups[] = {{Kind::ours, "ours"},
                                                   {Kind::plain, "our plain versions"},
                                                   {Kind::floor, "the floor"},
                                                   {Kind::other, "used instead"}};
    double least = rows.back()->timing.p25;
    for (const auto& [kind, name] : groups) {
        Series series;
        series.name = name;
        series.style.kind = SeriesStyle::Kind::points;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (rows[i]->kind != kind) continue;
            series.x.push_back(rows[i]->timing.median);
            series.y.push_back(static_cast<double>(i));
        }
        figure.series.push_back(series);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Series stem;
        stem.style = {.kind = SeriesStyle::Kind::line, .colour = SeriesStyle::neutral, .faint = true};
        stem.x = {0.5 * least, rows[i]->timing.median};
        stem.y = {static_cast<double>(i), static_cast<double>(i)};
        figure.series.insert(figure.series.begin(), stem);
        figure.y_ticks.push_back({static_cast<double>(i), fmt::format("{}  {:.2f} ms", rows[i]->timing.label,
                                                                      rows[i]->timing.median)});
    }
    figure.x_range = {0.5 * least, 2.0 * rows.front()->timing.median};
    figure.y_range = {-0.7, static_cast<double>(rows.size()) - 0.3};
    figure.x_label = "median [ms]";
    return figure;
}

Figure latency_figure(const GraphBenchResult& graph) {
    Figure figure;
    figure.title = fmt::format("Capture to posts, {}×{} at {:g} frames per second", graph.width, graph.height,
                               graph.frames_per_second);
    figure.x_label = "age of the frame [ms]";
    figure.y_label = "frames up to that age [%]";
    figure.log_x = true;
    figure.y_range = {0.0, 100.0};
    for (const WayResult& way : graph.ways) {
        const StageResult* posts = way.stage("POSTS");
        if (posts == nullptr || posts->heard.ages.empty()) continue;
        Series series;
        series.name = way.title;
        series.style.kind = SeriesStyle::Kind::line;
        for (int percent = 0; percent <= 100; ++percent) {
            series.x.push_back(1e-3 * std::max(1.0, posts->heard.quantile(0.01 * percent)));
            series.y.push_back(percent);
        }
        figure.series.push_back(std::move(series));
    }
    return figure;
}

}  // namespace goalmouth::bench
