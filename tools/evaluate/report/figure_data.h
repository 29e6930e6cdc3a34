#pragma once

#include "tools/evaluate/report/figure.h"

#include <array>
#include <string>
#include <vector>

namespace goalmouth {

/// A series as gnuplot reads it: lines of "x y" or "x y low high", an empty line for each gap.
struct SeriesData {
    std::string lines;
    bool with_bars = false;
    bool empty = true;
};

/// Where bars of a figure stand: `shift` from their x, `width` wide.
struct BarPlace {
    double shift = 0.0;
    double width = 0.8;
};

/// Throws std::invalid_argument where lengths differ.
void check_lengths(const Series& series);

/// Points that are not finite, and those not above 0 on a logarithmic axis, become gaps.
SeriesData series_data(const Figure& figure, const Series& series, double shift);

/// The place of each series' bars; those of other kinds stay as they are.
std::vector<BarPlace> bar_places(const Figure& figure);

/// Smallest and largest number on either axis: where the diagonal begins and ends.
std::array<double, 2> diagonal_range(const Figure& figure);

}  // namespace goalmouth
