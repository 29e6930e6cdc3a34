#pragma once

#include "tools/evaluate/report/figure.h"

#include <cstddef>
#include <string>

namespace goalmouth {

/// Colour of text and neutral series (RRGGBB), which an inlined figure takes from its page.
inline constexpr const char* figure_ink = "1F2328";

/// Where things stand, in px of the SVG: the same for both terminals, which differ in what they take a
/// letter's size for.
struct FigureLayout {
    std::string title;   // in lines
    double above = 0.0;  // of the axes
    double below = 0.0;
    std::size_t legend_columns = 1;
    std::size_t longest_name = 0;  // characters
    int height = 0;
};

FigureLayout figure_layout(const Figure& figure);

/// What makes gnuplot's terminals draw to the same layout.
struct Terminal {
    double name_room;   // of a legend's name, in letters' widths: for any name
    double name_width;  // and for each of its letters
    double spacing;     // lines of the legend
    double tic_scale;
    double tic_offset;  // letters' heights
    double label_offset;
    double title_offset;
};
inline constexpr Terminal svg_terminal{2.0, -0.28, 1.0, 0.4, 0.45, 0.85, -0.3};
inline constexpr Terminal png_terminal{2.5, -0.28, 1.3, 0.6, 0.0, 0.0, 0.0};

/// Commands for margins, legend, ticks, title and x label.
std::string placement(const Figure& figure, const FigureLayout& layout, const Terminal& terminal);

}  // namespace goalmouth
