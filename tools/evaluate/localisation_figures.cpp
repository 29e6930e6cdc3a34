#include "tools/evaluate/localisation_figures.h"

#include "tools/evaluate/report/field_figure.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace goalmouth {
namespace {

constexpr double cm = 100.0;  // in a metre

SeriesStyle style(SeriesStyle::Kind kind, int colour) {
    SeriesStyle s;
    s.kind = kind;
    s.colour = colour;
    return s;
}

/// Mean over runs with bars of ±σ at every fifth time, and the filter's own σ dashed.
Figure over_time(const LocalisationResult& result, const std::string& title, const std::string& label,
                 double factor, double PoseQuality::*error, double PoseQuality::*sigma) {
    Figure figure;
    figure.title = title;
    figure.x_label = "time since the start [s]";
    figure.y_label = label;
    if (result.done.empty()) return figure;
    constexpr std::size_t every = 5;
    const std::vector<double>& times = result.done.front().times;
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        const int colour = static_cast<int>(d);
        Series mean{.name = result.detectors[d] + ": error, mean ± σ", .x = {}, .y = {}};
        mean.style = style(SeriesStyle::Kind::line_and_points, colour);
        Series own{.name = result.detectors[d] + ": the filter's own σ", .x = {}, .y = {}};
        own.style = style(SeriesStyle::Kind::line, colour);
        own.style.dashed = true;
        for (std::size_t t = 0; t < times.size(); t += every) {
            double sum = 0.0;
            double squares = 0.0;
            double own_sum = 0.0;
            for (const LocalisationRun& run : result.done) {
                const PoseQuality& q = run.detectors[d].track[t];
                sum += q.*error;
                squares += q.*error * q.*error;
                own_sum += q.*sigma;
            }
            const auto n = static_cast<double>(result.done.size());
            const double average = sum / n;
            mean.x.push_back(times[t]);
            mean.y.push_back(factor * average);
            mean.error.push_back(factor * std::sqrt(std::max(0.0, squares / n - average * average)));
            own.x.push_back(times[t]);
            own.y.push_back(factor * own_sum / n);
        }
        figure.series.push_back(mean);
        figure.series.push_back(own);
    }
    return figure;
}

}  // namespace

Figure paths_figure(const LocalisationResult& result, std::size_t detector) {
    Figure figure = field_figure(result.field, result.detectors[detector]);
    for (std::size_t i = 0; i < result.done.size(); ++i) {
        SeriesStyle faint = style(SeriesStyle::Kind::line, static_cast<int>(detector));
        faint.faint = true;
        figure.series.push_back(
            path_series(result.done[i].detectors[detector].path, i == 0 ? "estimated, each run" : "", faint));
    }
    if (!result.done.empty()) {
        figure.series.push_back(
            path_series(result.done.front().truth, "true",
                        style(SeriesStyle::Kind::line, static_cast<int>(result.detectors.size()))));
    }
    return figure;
}

Figure position_over_time(const LocalisationResult& result) {
    return over_time(result, "Position", "position error [cm]", cm, &PoseQuality::position_error,
                     &PoseQuality::position_sigma);
}

Figure heading_over_time(const LocalisationResult& result) {
    return over_time(result, "Heading", "heading error [rad]", 1.0, &PoseQuality::heading_error,
                     &PoseQuality::heading_sigma);
}

Figure ends_figure(const LocalisationResult& result) {
    Figure figure;
    figure.title = "Errors at the end of each run";
    figure.x_label = "position error, last second [cm]";
    figure.y_label = "heading error, last second [rad]";
    figure.log_x = figure.log_y = true;
    constexpr double least = 1e-4;  // m, rad: a logarithm needs some
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        Series series{.name = result.detectors[d], .x = {}, .y = {}};
        series.style = style(SeriesStyle::Kind::points, static_cast<int>(d));
        for (const LocalisationRun& run : result.done) {
            series.x.push_back(cm * std::max(least, run.detectors[d].end.position_error));
            series.y.push_back(std::max(least, run.detectors[d].end.heading_error));
        }
        figure.series.push_back(series);
    }
    return figure;
}

Figure end_distribution_figure(const LocalisationResult& result) {
    Figure figure;
    figure.title = "How many runs end how well";
    figure.x_label = "position error, last second [cm]";
    figure.y_label = "runs with at most that [%]";
    figure.y_range = {0.0, 100.0};
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        std::vector<double> errors;
        for (const LocalisationRun& run : result.done)
            errors.push_back(cm * run.detectors[d].end.position_error);
        std::sort(errors.begin(), errors.end());
        Series series{.name = result.detectors[d], .x = {0.0}, .y = {0.0}};
        series.style = style(SeriesStyle::Kind::steps, static_cast<int>(d));
        for (std::size_t i = 0; i < errors.size(); ++i) {
            series.x.push_back(errors[i]);
            series.y.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(errors.size()));
        }
        figure.series.push_back(series);
    }
    return figure;
}

}  // namespace goalmouth
