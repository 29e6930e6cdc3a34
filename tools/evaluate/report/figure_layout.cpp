#include "tools/evaluate/report/figure_layout.h"

#include "tools/evaluate/report/clean_text.h"
#include "tools/evaluate/report/gnuplot_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace goalmouth {
namespace {

/// In two or more lines where it is longer than the drawing is wide.
std::string wrapped(const std::string& title, int width) {
    constexpr double px_per_character = 9.0;
    const auto longest = static_cast<std::size_t>(std::max(8.0, width / px_per_character));
    std::istringstream words(clean_text(title));
    std::string result;
    std::size_t column = 0;
    for (std::string word; words >> word;) {
        const std::size_t length = characters_in(word);
        if (!result.empty()) {
            const bool fits = column + 1 + length <= longest;
            result += fits ? ' ' : '\n';
            column = fits ? column + 1 : 0;
        }
        result += word;
        column += length;
    }
    return result;
}

}  // namespace

FigureLayout figure_layout(const Figure& figure) {
    constexpr double line_px = 20.0;
    constexpr double px_per_character = 7.2;
    constexpr double sample_px = 60.0;
    constexpr std::size_t usual_rows = 2;  // further ones make the figure higher
    FigureLayout layout;
    layout.above = 16.0;
    layout.title = wrapped(figure.title, figure.width);
    if (!layout.title.empty())
        layout.above +=
            line_px * static_cast<double>(1 + std::count(layout.title.begin(), layout.title.end(), '\n')) +
            8.0;
    std::size_t names = 0;
    for (const Series& series : figure.series) {
        if (series.name.empty()) continue;
        ++names;
        layout.longest_name = std::max(layout.longest_name, characters_in(one_line(series.name)));
    }
    const double column_px = px_per_character * static_cast<double>(layout.longest_name) + sample_px;
    layout.legend_columns =
        std::max<std::size_t>(1, static_cast<std::size_t>(0.9 * figure.width / column_px));
    const std::size_t rows = (names + layout.legend_columns - 1) / layout.legend_columns;
    if (rows > 1) layout.legend_columns = (names + rows - 1) / rows;
    layout.below = 34.0 + (figure.x_label.empty() ? 0.0 : line_px) +
                   (rows > 0 ? line_px * static_cast<double>(rows) + 10.0 : 0.0);
    layout.height = figure.height;
    if (rows > usual_rows)
        layout.height += static_cast<int>(line_px * static_cast<double>(rows - usual_rows));
    return layout;
}

std::string placement(const Figure& figure, const FigureLayout& layout, const Terminal& terminal) {
    const std::string ink = fmt::format("textcolor rgb '#{}'", figure_ink);
    std::string s = fmt::format("set tmargin at screen {}\nset bmargin at screen {}\n",
                                1.0 - layout.above / layout.height, layout.below / layout.height);
    s += fmt::format(
        "set key bmargin center horizontal Left reverse maxcols {} width {} samplen 2.5 spacing {} {}\n",
        layout.legend_columns,
        terminal.name_room + terminal.name_width * static_cast<double>(layout.longest_name), terminal.spacing,
        ink);
    s += fmt::format("set tics nomirror out scale {} {}\n", terminal.tic_scale, ink);
    s += fmt::format("set xtics offset 0,{}\n", terminal.tic_offset);
    s += fmt::format("set xlabel {} offset 0,{} {}\n", gnuplot_string(one_line(figure.x_label)),
                     terminal.label_offset, ink);
    if (!layout.title.empty())
        s += fmt::format("set title {} font ',15' offset 0,{} {}\n", gnuplot_string(layout.title),
                         terminal.title_offset, ink);
    return s;
}

}  // namespace goalmouth
