#include "tools/evaluate/report/figure_script.h"

#include "tools/evaluate/report/figure_data.h"
#include "tools/evaluate/report/figure_layout.h"
#include "tools/evaluate/report/gnuplot_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <stdexcept>

namespace goalmouth {
namespace {

using Kind = SeriesStyle::Kind;

struct Look {
    const char* colour;  // RRGGBB
    int filled;          // gnuplot's point types
    int open;
};

// The palette of Okabe and Ito (Color Universal Design) without black, and a grey.
constexpr std::array<Look, figure_colours> palette{{{"0072B2", 7, 6},
                                                    {"D55E00", 5, 4},
                                                    {"009E73", 9, 8},
                                                    {"CC79A7", 13, 12},
                                                    {"E69F00", 11, 10},
                                                    {"56B4E9", 15, 14},
                                                    {"8C8C8C", 2, 1}}};
constexpr Look neutral_look{figure_ink, 7, 6};
constexpr const char* axis_colour = "6E7781";
constexpr const char* grid_colour = "C08C959F";  // mostly transparent: on white as on black

/// A series with all that its commands are made of.
struct Drawing {
    const Series* series = nullptr;
    Look look = neutral_look;
    SeriesData data;
    BarPlace bars;
    std::string block;  // name of its data
};

/// The palette place of each series; -1 for neutral.
std::vector<int> colours_of(const std::vector<Series>& series) {
    std::set<int> taken;
    std::vector<int> colours;
    int next = 0;
    for (const Series& s : series) {
        int colour = -1;
        if (s.style.colour >= 0) {
            colour = s.style.colour % figure_colours;
        } else if (s.style.colour == SeriesStyle::next) {
            while (static_cast<int>(taken.size()) < figure_colours && taken.count(next % figure_colours) > 0)
                ++next;
            colour = next++ % figure_colours;
        }
        if (colour >= 0) taken.insert(colour);
        colours.push_back(colour);
    }
    return colours;
}

std::string colour_of(const Drawing& d, const char* alpha = nullptr) {
    if (alpha == nullptr) alpha = d.series->style.faint ? "99" : "";
    return fmt::format("lc rgb '#{}{}'", alpha, d.look.colour);
}

std::string line_of(const Drawing& d) {
    return fmt::format("lw {} dt {} {}", d.series->style.faint ? 1.2 : 2.0,
                       d.series->style.dashed ? "(10,5)" : "1", colour_of(d));
}

std::string marker_of(const Drawing& d) {
    return fmt::format("pt {} ps {} lw 1.6 {}", d.series->style.hollow ? d.look.open : d.look.filled,
                       d.series->style.faint ? 0.5 : 1.0, colour_of(d));
}

std::string box_of(const Drawing& d) {
    return d.series->style.hollow
               ? fmt::format("fs empty border lw 1.6 {}", colour_of(d))
               : fmt::format("fs solid {} noborder {}", d.series->style.faint ? 0.3 : 0.85, colour_of(d, ""));
}

/// The parts of one series, those behind first.
std::vector<std::string> parts_of(const Drawing& d) {
    std::vector<std::string> parts;
    if (d.data.empty) return parts;
    const Kind kind = d.series->style.kind;
    const auto add = [&](const std::string& columns, const std::string& how) {
        parts.push_back(fmt::format("{} using {} with {} notitle", d.block, columns, how));
    };
    if (kind == Kind::bars) add(fmt::format("1:2:({})", d.bars.width), "boxes " + box_of(d));
    if (kind == Kind::steps) add("1:2", "steps " + line_of(d));
    if (kind == Kind::line || kind == Kind::line_and_points) add("1:2", "lines " + line_of(d));
    // Not as gnuplot's error bars, which clear a disc in white about each point.
    if (d.data.with_bars)
        add("1:3:(0):($4-$3)",
            fmt::format(
                "vectors heads size screen 0.005,90 nofilled lw 1.2 {}",
                kind == Kind::bars ? fmt::format("lc rgb '#{}'", neutral_look.colour) : colour_of(d)));
    if (kind == Kind::points || kind == Kind::line_and_points) add("1:2", "points " + marker_of(d));
    return parts;
}

std::string legend_of(const Drawing& d) {
    std::string how;
    switch (d.series->style.kind) {
        case Kind::line_and_points:
            how = fmt::format("linespoints pt {} ps 1 {}",
                              d.series->style.hollow ? d.look.open : d.look.filled, line_of(d));
            break;
        case Kind::points:
            how = "points " + marker_of(d);
            break;
        case Kind::bars:
            how = "boxes " + box_of(d);
            break;
        case Kind::line:
        case Kind::steps:
            how = "lines " + line_of(d);
            break;
    }
    return fmt::format("keyentry with {} title {}", how, gnuplot_string(one_line(d.series->name)));
}

std::string range_of(const std::optional<std::array<double, 2>>& range, const char* automatic) {
    if (!range) return automatic;
    const auto [from, to] = *range;
    if (!std::isfinite(from) || !std::isfinite(to) || from == to)
        throw std::invalid_argument(fmt::format("a figure's range from {} to {}", from, to));
    return fmt::format("[{}:{}]", from, to);
}

std::string ticks_of(const char* axis, const std::vector<Tick>& ticks) {
    if (ticks.empty()) return "";
    std::string list;
    for (const Tick& tick : ticks) {
        std::string label;  // a format of the number, for gnuplot
        for (const char c : one_line(tick.label)) label += c == '%' ? std::string("%%") : std::string(1, c);
        list += fmt::format("{}{} {}", list.empty() ? "" : ", ", gnuplot_string(label), tick.at);
    }
    return fmt::format("set {} ({})\n", axis, list);
}

/// Numbers that count or measure begin at 0, where no reader is misled.
const char* automatic_y_range(const Figure& figure) {
    if (figure.log_y) return "[*:*]";
    bool bars = false;
    bool negative = false;
    for (const Series& series : figure.series) {
        bars = bars || series.style.kind == Kind::bars;
        for (const double y : series.y) negative = negative || y < 0.0;
    }
    if (bars) return "[*<0:0<*]";
    return negative ? "[*:*]" : "[0<*:*]";
}

std::string axes_of(const Figure& figure) {
    const std::string ink = fmt::format("textcolor rgb '#{}'", neutral_look.colour);
    std::string s;
    s += fmt::format("set ylabel {} {}\n", gnuplot_string(one_line(figure.y_label)), ink);
    s += fmt::format("set border 3 lw 1 lc rgb '#{}'\n", axis_colour);
    s += ticks_of("xtics", figure.x_ticks) + ticks_of("ytics", figure.y_ticks);
    s += fmt::format("set grid xtics ytics lt 1 lw 1 lc rgb '#{0}', lt 1 lw 1 lc rgb '#{0}'\n", grid_colour);
    s += "set format '%g'\nset minussign\nset clip two\n";
    if (figure.log_x) s += "set logscale x\n";
    if (figure.log_y) s += "set logscale y\n";
    if (!figure.x_range && !figure.log_x) s += "set offsets graph 0.03, graph 0.03, 0, 0\n";
    s += "set xrange " + range_of(figure.x_range, "[*:*] noextend") + "\n";
    s += "set yrange " + range_of(figure.y_range, automatic_y_range(figure)) + "\n";
    if (figure.equal_axes) s += "set size ratio -1\n";
    return s;
}

/// The plot command; for a figure without any point, its axes and a word.
std::string plot_of(const Figure& figure, const std::vector<Drawing>& drawings) {
    std::vector<std::string> parts;
    if (figure.diagonal)
        parts.push_back(fmt::format("$diagonal using 1:2 with lines lw 1.2 dt (10,5) lc rgb '#80{}' notitle",
                                    axis_colour));
    bool any = false;
    for (const Drawing& d : drawings) {
        any = any || !d.data.empty;
        for (std::string& part : parts_of(d)) parts.push_back(std::move(part));
    }
    std::string before;
    if (!any) {
        if (!figure.x_range) before += fmt::format("set xrange [{}:10]\n", figure.log_x ? 1 : 0);
        if (!figure.y_range) before += fmt::format("set yrange [{}:10]\n", figure.log_y ? 1 : 0);
        before += fmt::format("set label 1 'no data' at graph 0.5, graph 0.5 center textcolor rgb '#{}'\n",
                              axis_colour);
        parts.push_back("NaN notitle");
    }
    for (const Drawing& d : drawings) {
        if (!d.series->name.empty()) parts.push_back(legend_of(d));
    }
    return before + fmt::format("plot {}\n", fmt::join(parts, ", \\\n     "));
}

}  // namespace

std::string figure_script(const Figure& figure) {
    if (figure.width < 100 || figure.height < 100)
        throw std::invalid_argument(fmt::format("a figure of {}x{} px", figure.width, figure.height));
    std::vector<Drawing> drawings;
    const std::vector<int> colours = colours_of(figure.series);
    const std::vector<BarPlace> places = bar_places(figure);
    std::string data;
    for (std::size_t i = 0; i < figure.series.size(); ++i) {
        const Series& series = figure.series[i];
        check_lengths(series);
        Drawing d;
        d.series = &series;
        if (colours[i] >= 0) d.look = palette[static_cast<std::size_t>(colours[i])];
        d.data = series_data(figure, series, places[i].shift);
        d.bars = places[i];
        d.block = fmt::format("$series{}", i + 1);
        data += fmt::format("{} << END\n{}END\n", d.block, d.data.lines);
        drawings.push_back(std::move(d));
    }
    if (figure.diagonal) {
        const auto [from, to] = diagonal_range(figure);
        data += fmt::format("$diagonal << END\n{0} {0}\n{1} {1}\nEND\n", from, to);
    }
    const std::string plot = plot_of(figure, drawings);
    const FigureLayout layout = figure_layout(figure);
    return fmt::format("set encoding utf8\n{}", data) +
           fmt::format("set terminal svg size {},{} noenhanced font 'DejaVu Sans,13'\nset output '{}'\n",
                       figure.width, layout.height, figure_svg_name) +
           axes_of(figure) + placement(figure, layout, svg_terminal) + plot + "set output\n" +
           fmt::format(
               "set terminal pngcairo size {},{} noenhanced font 'DejaVu Sans,13' fontscale 1.5 "
               "linewidth 2 pointscale 2.8 background '#FFFFFF'\nset output '{}'\n",
               2 * figure.width, 2 * layout.height, figure_png_name) +
           placement(figure, layout, png_terminal) + plot + "set output\n";
}

}  // namespace goalmouth
