#include "tools/evaluate/paper_figures.h"

#include "core/evaluation/cell.h"

#include <fmt/format.h>
#include <functional>
#include <string>

namespace goalmouth {
namespace {

Figure figure_of(const PaperResult& result, std::size_t detector, std::size_t scene) {
    Figure figure;
    figure.title = fmt::format("{}, scene {}, {}", result.detectors[detector], result.scenes[scene],
                               result.options.size);
    figure.x_label = "true distance [cm]";
    figure.x_range = {0.0, 660.0};
    for (const int distance : cell_distances_cm)
        figure.x_ticks.push_back({static_cast<double>(distance), std::to_string(distance)});
    figure.width = 560;
    figure.height = 400;
    return figure;
}

/// One series for each tilt; `add` gives it the point of a cell, moved by `dodge` [cm].
void add_series(Figure& figure, const RecordTable& table, std::size_t detector, std::size_t scene,
                const std::function<void(Series&, double distance_cm, double dodge, const Summary&)>& add) {
    constexpr std::size_t distances = cell_distances_cm.size();
    for (std::size_t t = 0; t < cell_tilts_deg.size(); ++t) {
        Series series;
        series.name = fmt::format("tilt {}°", cell_tilts_deg[t]);
        const double dodge = tilt_dodge_cm * (static_cast<double>(t) - 1.0);
        for (std::size_t i = 0; i < distances; ++i)
            add(series, cell_distances_cm[i], dodge,
                table.cell(detector, scene, static_cast<int>(t * distances + i)));
        figure.series.push_back(series);
    }
}

}  // namespace

Figure detection_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                        std::size_t scene) {
    Figure figure = figure_of(result, detector, scene);
    figure.y_label = "posts detected [%]";
    figure.y_range = {0.0, 100.0};
    add_series(figure, table, detector, scene,
               [](Series& series, double distance, double dodge, const Summary& cell) {
                   if (cell.posts == 0) return;
                   series.x.push_back(distance + dodge);
                   series.y.push_back(100.0 * cell.detection_rate());
               });
    return figure;
}

Figure distance_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                       std::size_t scene) {
    Figure figure = figure_of(result, detector, scene);
    figure.y_label = "estimated distance [cm]";
    figure.diagonal = true;
    add_series(figure, table, detector, scene,
               [](Series& series, double distance, double dodge, const Summary& cell) {
                   if (!cell.in_line.distance) return;
                   series.x.push_back(distance + dodge);
                   series.y.push_back(distance + dodge + 100.0 * cell.in_line.distance->bias);
                   series.error.push_back(100.0 * cell.in_line.distance->sigma);
               });
    return figure;
}

Figure bound_figure(const PaperResult& result, const RecordTable& table, std::size_t detector,
                    std::size_t scene) {
    Figure figure = figure_of(result, detector, scene);
    figure.y_label = "RMSE and bound of the distance [cm]";
    figure.log_y = true;
    add_series(figure, table, detector, scene,
               [](Series& series, double distance, double dodge, const Summary& cell) {
                   if (!cell.in_line.distance || !(cell.in_line.distance->rmse > 0.0)) return;
                   series.x.push_back(distance + dodge);
                   series.y.push_back(100.0 * cell.in_line.distance->rmse);
               });
    const std::size_t tilts = figure.series.size();
    add_series(figure, table, detector, scene,
               [](Series& series, double distance, double dodge, const Summary& cell) {
                   if (!cell.in_line.bound) return;
                   series.x.push_back(distance + dodge);
                   series.y.push_back(100.0 * *cell.in_line.bound);
               });
    for (std::size_t i = 0; i < tilts; ++i) {
        figure.series[i].style.colour = static_cast<int>(i);
        SeriesStyle& bound = figure.series[tilts + i].style;
        bound.colour = static_cast<int>(i);
        bound.dashed = true;
        bound.hollow = true;
        figure.series[tilts + i].name = fmt::format("bound, {}°", cell_tilts_deg[i]);
    }
    return figure;
}

}  // namespace goalmouth
