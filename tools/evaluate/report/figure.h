#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// How a series is drawn. Series of one `colour` share the marker too, so that a pair of curves (ours and the
/// paper's, say) is told apart by `dashed` and `hollow`.
struct SeriesStyle {
    enum class Kind {
        line_and_points,
        points,
        line,
        bars,   // from zero up; series of bars stand side by side at each x
        steps,  // histogram outline: y holds from this x to the next
    };
    static constexpr int next = -1;     // the next colour that no earlier series took
    static constexpr int neutral = -2;  // the colour of the axes
    Kind kind = Kind::line_and_points;
    int colour = next;    // place in the palette, which repeats after figure_colours
    bool dashed = false;  // lines
    bool hollow = false;  // markers, bars
    bool faint = false;   // thin and pale: what lies behind the data
};

/// Colours that people with any colour vision tell apart on white and on near-black, each with a marker of
/// its own.
inline constexpr int figure_colours = 7;

/// Points in the order in which a line joins them. A point that is not finite leaves a gap. x, y and, where
/// they are not empty, error, low and high are equally long.
struct Series {
    std::string name = {};  // in the legend; "": not there
    std::vector<double> x = {};
    std::vector<double> y = {};
    std::vector<double> error = {};  // bars of y ± error
    std::vector<double> low = {};    // or bars from low to high
    std::vector<double> high = {};
    SeriesStyle style = {};
};

/// A name on an axis in place of numbers.
struct Tick {
    double at = 0.0;
    std::string label = {};
};

struct Figure {
    std::string title = {};  // above the drawing; may be empty
    std::string x_label = {};
    std::string y_label = {};
    std::optional<std::array<double, 2>> x_range = {};  // from the data where not given
    std::optional<std::array<double, 2>> y_range = {};
    std::vector<Tick> x_ticks = {};  // empty: numbers
    std::vector<Tick> y_ticks = {};
    bool log_x = false;
    bool log_y = false;
    bool equal_axes = false;  // a metre is as long up as it is along: maps
    bool diagonal = false;    // faint y = x: estimated over true
    std::vector<Series> series = {};
    int width = 760;   // px, of the SVG; the PNG has twice as many
    int height = 460;  // more where the legend needs more than two lines
};

struct DrawnFigure {
    std::filesystem::path svg;  // on white, for files and README
    std::filesystem::path png;
    /// The SVG as HtmlPage::figure() takes it: no white page, text and axes in the page's own colour, and ids
    /// that no other figure of the page has.
    std::string inline_svg;
    std::string title;
};

/// Draws with gnuplot, as `folder`/`stem`.svg and `folder`/`stem`.png. Figures of one page have different
/// stems (letters, digits, '-' and '_'). The same figure gives the same bytes. Texts are taken as they are:
/// nothing in them is markup. Throws ConfigurationError where gnuplot is missing, fails (with what it said)
/// or does not end within a minute, or the folder cannot be written; std::invalid_argument where lengths
/// differ.
DrawnFigure draw_figure(const Figure& figure, const std::filesystem::path& folder, const std::string& stem);

/// Throws ConfigurationError, which begins with `option` and names the Debian package, unless a gnuplot is
/// there that draws what we need. To be called before the work.
void expect_gnuplot(const std::string& option = "--report");

}  // namespace goalmouth
