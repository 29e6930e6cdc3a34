#pragma once

#include "tools/evaluate/report/figure.h"

#include <string>

namespace goalmouth {

/// Files that the script writes to its working directory.
inline constexpr const char* figure_svg_name = "figure.svg";
inline constexpr const char* figure_png_name = "figure.png";

/// What gnuplot is told to draw the figure as SVG and as PNG. Throws std::invalid_argument where the lengths
/// of a series differ or a range is not one.
std::string figure_script(const Figure& figure);

}  // namespace goalmouth
