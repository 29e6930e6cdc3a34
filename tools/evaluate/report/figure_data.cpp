#include "tools/evaluate/report/figure_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace goalmouth {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool drawable(double value, bool logarithmic) {
    return std::isfinite(value) && (!logarithmic || value > 0.0);
}

}  // namespace

void check_lengths(const Series& series) {
    const auto expect = [&](const std::vector<double>& values, const char* what) {
        if (values.size() != series.x.size())
            throw std::invalid_argument(fmt::format("series '{}': {} x, but {} {}", series.name,
                                                    series.x.size(), values.size(), what));
    };
    expect(series.y, "y");
    if (!series.error.empty()) expect(series.error, "errors");
    if (series.low.empty() != series.high.empty())
        throw std::invalid_argument(fmt::format("series '{}': low without high", series.name));
    if (!series.low.empty()) {
        expect(series.low, "low");
        expect(series.high, "high");
    }
}

SeriesData series_data(const Figure& figure, const Series& series, double shift) {
    SeriesData data;
    data.with_bars = !series.error.empty() || !series.low.empty();
    bool gap = false;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const double x = series.x[i] + shift;
        const double y = series.y[i];
        if (!drawable(x, figure.log_x) || !drawable(y, figure.log_y)) {
            gap = true;
            continue;
        }
        if (gap && !data.empty) data.lines += '\n';
        gap = false;
        data.empty = false;
        data.lines += fmt::format("{} {}", x, y);
        if (data.with_bars) {
            double low = series.low.empty() ? y - series.error[i] : series.low[i];
            double high = series.high.empty() ? y + series.error[i] : series.high[i];
            if (!drawable(low, figure.log_y)) low = y;
            if (!drawable(high, figure.log_y)) high = y;
            data.lines += fmt::format(" {} {}", low, high);
        }
        data.lines += '\n';
    }
    return data;
}

std::vector<BarPlace> bar_places(const Figure& figure) {
    std::vector<double> at;
    std::size_t together = 0;
    for (const Series& series : figure.series) {
        if (series.style.kind != SeriesStyle::Kind::bars) continue;
        ++together;
        for (const double x : series.x) {
            if (std::isfinite(x)) at.push_back(x);
        }
    }
    std::sort(at.begin(), at.end());
    double step = infinity;
    for (std::size_t i = 1; i < at.size(); ++i) {
        if (at[i] > at[i - 1]) step = std::min(step, at[i] - at[i - 1]);
    }
    if (!std::isfinite(step)) step = 1.0;

    constexpr double filled = 0.8;  // of the room between two x
    std::vector<BarPlace> places(figure.series.size());
    std::size_t nth = 0;
    for (std::size_t i = 0; i < figure.series.size(); ++i) {
        if (figure.series[i].style.kind != SeriesStyle::Kind::bars) continue;
        places[i].width = filled * step / static_cast<double>(together);
        places[i].shift =
            places[i].width * (static_cast<double>(nth) - 0.5 * (static_cast<double>(together) - 1.0));
        ++nth;
    }
    return places;
}

std::array<double, 2> diagonal_range(const Figure& figure) {
    double low = infinity;
    double high = -infinity;
    const auto include = [&](double value, bool logarithmic) {
        if (!drawable(value, logarithmic)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    };
    const auto include_axis = [&](const std::optional<std::array<double, 2>>& range, bool logarithmic,
                                  std::vector<double> Series::*values) {
        if (range) {
            for (const double end : *range) include(end, logarithmic);
            return;
        }
        for (const Series& series : figure.series) {
            for (const double value : series.*values) include(value, logarithmic);
        }
    };
    include_axis(figure.x_range, figure.log_x, &Series::x);
    include_axis(figure.y_range, figure.log_y, &Series::y);
    return low < high ? std::array{low, high} : std::array{0.0, 1.0};
}

}  // namespace goalmouth
