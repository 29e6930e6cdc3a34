#include "tools/evaluate/report/figure.h"

#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/refusal.h"
#include "tests/support/well_formed.h"
#include "tests/tools_evaluate_report/path_variable.h"
#include "tools/evaluate/report/field_figure.h"
#include "tools/evaluate/report/figure_script.h"
#include "tools/evaluate/report/gnuplot.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

using test::count;
using test::message_of;
using test::read_text;
using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Figure two_curves() {
    Figure figure;
    figure.title = "Detection rate over distance";
    figure.x_label = "distance [cm]";
    figure.y_label = "detected [%]";
    figure.y_range = {0.0, 105.0};
    figure.series.push_back({.name = "0°", .x = {60, 150, 300}, .y = {98.5, 97, 90}, .error = {1, 1, 2}});
    figure.series.push_back({.name = "10°", .x = {60, 150, 300}, .y = {58, 87, 30}});
    return figure;
}

/// Pixels of a PNG within 12 of an RGB colour.
int pixels_like(const cv::Mat& picture, int r, int g, int b) {
    int n = 0;
    for (int y = 0; y < picture.rows; ++y) {
        for (int x = 0; x < picture.cols; ++x) {
            const cv::Vec3b& p = picture.at<cv::Vec3b>(y, x);
            if (std::abs(p[2] - r) < 12 && std::abs(p[1] - g) < 12 && std::abs(p[0] - b) < 12) ++n;
        }
    }
    return n;
}

/// Pixels that are not the page's white.
int drawn_pixels(const cv::Mat& picture) {
    return picture.rows * picture.cols - pixels_like(picture, 255, 255, 255);
}

TEST(FigureScript, HoldsTheDataAsPoints) {
    const std::string script = figure_script(two_curves());
    EXPECT_THAT(script, HasSubstr("60 98.5 97.5 99.5\n150 97 96 98\n300 90 88 92\n"));
    EXPECT_THAT(script, HasSubstr("60 58\n150 87\n300 30\n"));
    EXPECT_THAT(script, HasSubstr("set yrange [0:105]"));
}

TEST(FigureScript, KeepsEveryDigit) {
    Figure figure;
    figure.series.push_back({.x = {0.1}, .y = {1.0 / 3.0}});
    EXPECT_THAT(figure_script(figure), HasSubstr("0.1 0.3333333333333333\n"));
}

TEST(FigureScript, LeavesGapsWherePointsAreAbsent) {
    Figure figure;
    figure.series.push_back({.x = {nan, 1, 2, 3, 4, 5, 6}, .y = {0, 10, nan, INFINITY, 40, 50, nan}});
    EXPECT_THAT(figure_script(figure), HasSubstr("<< END\n1 10\n\n4 40\n5 50\nEND\n"));
}

TEST(FigureScript, LeavesOutWhatALogarithmicAxisCannotShow) {
    Figure figure;
    figure.log_y = true;
    figure.series.push_back({.x = {1, 2, 3}, .y = {10, 0, 30}, .low = {-1, 0, 20}, .high = {12, 1, 35}});
    EXPECT_THAT(figure_script(figure), HasSubstr("<< END\n1 10 10 12\n\n3 30 20 35\nEND\n"));
}

TEST(FigureScript, PutsBarsSideBySide) {
    Figure figure;
    figure.series.push_back({.x = {0, 1}, .y = {3, 4}, .style = {.kind = SeriesStyle::Kind::bars}});
    figure.series.push_back({.x = {0, 1}, .y = {5, 6}, .style = {.kind = SeriesStyle::Kind::bars}});
    const std::string script = figure_script(figure);
    EXPECT_THAT(script, HasSubstr("-0.2 3\n0.8 4\n"));
    EXPECT_THAT(script, HasSubstr("0.2 5\n1.2 6\n"));
}

TEST(FigureScript, GivesEverySeriesAColourThatNoEarlierOneHas) {
    Figure figure;
    figure.series.push_back({.x = {1}, .y = {1}, .style = {.colour = 0}});
    figure.series.push_back({.x = {1}, .y = {2}});
    const std::string script = figure_script(figure);
    EXPECT_EQ(count(script, "$series1 using 1:2 with points pt 7 ps 1 lw 1.6 lc rgb '#0072B2'"), 2u);
    EXPECT_EQ(count(script, "$series2 using 1:2 with points pt 5 ps 1 lw 1.6 lc rgb '#D55E00'"), 2u);
}

TEST(FigureScript, RefusesSeriesOfDifferentLengths) {
    Figure figure;
    figure.series.push_back({.x = {1, 2}, .y = {1}});
    EXPECT_THROW(figure_script(figure), std::invalid_argument);
    figure.series[0].y = {1, 2};
    figure.series[0].error = {1};
    EXPECT_THROW(figure_script(figure), std::invalid_argument);
    figure.series[0].error.clear();
    figure.series[0].low = {0, 1};
    EXPECT_THROW(figure_script(figure), std::invalid_argument);
    figure.series.clear();
    figure.x_range = {1.0, 1.0};
    EXPECT_THROW(figure_script(figure), std::invalid_argument);
}

TEST(Figure, DrawsEveryPointIntoTheSvg) {
    const test::TemporaryFolder folder;
    const DrawnFigure drawn = draw_figure(two_curves(), folder.path(), "rate");
    const std::string svg = read_text(drawn.svg);
    EXPECT_EQ(test::fault_in_markup(svg), "");
    // Three points and one in the legend, as filled circles and squares.
    EXPECT_EQ(count(svg, "<use xlink:href='#gpPt6' transform"), 4u);
    EXPECT_EQ(count(svg, "<use xlink:href='#gpPt4' transform"), 4u);
    EXPECT_THAT(svg, HasSubstr("<text>10°</text>"));
    EXPECT_THAT(svg, HasSubstr("<title>Detection rate over distance</title>"));
    EXPECT_THAT(svg, Not(HasSubstr("gnuplot_plot_1</title>")));
}

TEST(Figure, DrawsTheSameIntoThePng) {
    const test::TemporaryFolder folder;
    const DrawnFigure drawn = draw_figure(two_curves(), folder.path(), "rate");
    const cv::Mat png = cv::imread(drawn.png.string());
    ASSERT_EQ(png.size(), cv::Size(1520, 920));
    EXPECT_GT(pixels_like(png, 0x00, 0x72, 0xB2), 1500);
    EXPECT_GT(pixels_like(png, 0xD5, 0x5E, 0x00), 1500);
    EXPECT_GT(pixels_like(png, 31, 35, 40), 1500);  // text
    EXPECT_EQ(pixels_like(png, 0x00, 0x9E, 0x73), 0);
}

TEST(Figure, IsTheSameBytesWhenDrawnAgain) {
    const test::TemporaryFolder folder;
    const DrawnFigure first = draw_figure(two_curves(), folder.path(), "first");
    const DrawnFigure again = draw_figure(two_curves(), folder.path(), "again");
    EXPECT_EQ(read_bytes(first.png), read_bytes(again.png));
    EXPECT_EQ(read_bytes(first.svg), read_bytes(again.svg));
}

TEST(Figure, LeavesNothingElseInTheFolder) {
    const test::TemporaryFolder folder;
    draw_figure(two_curves(), folder.path(), "rate");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(Figure, ShowsEveryTextLiterally) {
    const test::TemporaryFolder folder;
    const std::string hostile = "a_b^c {d} @e & ~f <b> \"q\" 'r' \\n %s `date` $x é±σ²";
    const std::string escaped = "a_b^c {d} @e &amp; ~f &lt;b>";
    Figure figure = two_curves();
    figure.title = hostile;
    figure.x_label = hostile;
    figure.y_label = hostile;
    figure.series[0].name = hostile;
    figure.series[1].name = "two\nlines\tand \x01 control, \xFF";
    figure.x_ticks = {{60, hostile}};
    const DrawnFigure drawn = draw_figure(figure, folder.path(), "hostile");
    const std::string svg = read_text(drawn.svg);
    EXPECT_EQ(test::fault_in_markup(svg), "");
    EXPECT_EQ(count(svg, escaped), 5u);  // title, labels, legend and tick
    EXPECT_GE(count(svg, "\\n %s `date` $x é±σ²"), 5u);
    EXPECT_THAT(svg, HasSubstr("two lines and  control, \xEF\xBF\xBD"));
    EXPECT_EQ(test::fault_in_markup(drawn.inline_svg), "");
}

TEST(Figure, CanBeInlinedBesideOthers) {
    const test::TemporaryFolder folder;
    const std::string page = draw_figure(two_curves(), folder.path(), "one").inline_svg +
                             draw_figure(two_curves(), folder.path(), "two").inline_svg;
    EXPECT_EQ(test::fault_in_markup(page), "");
    EXPECT_EQ(test::repeated_id(page), "");
    EXPECT_THAT(page, Not(HasSubstr("http:")));
    EXPECT_THAT(page, Not(HasSubstr("'#gp")));
    EXPECT_THAT(page, Not(HasSubstr("#ffffff")));
    EXPECT_THAT(page, HasSubstr("fill=\"currentColor\""));
    EXPECT_THAT(page, HasSubstr("href='#two-gpPt6'"));
    EXPECT_THAT(page, HasSubstr("id='two-gpPt6'"));
}

TEST(Figure, WithoutAnyPointSaysSo) {
    const test::TemporaryFolder folder;
    Figure figure;
    figure.title = "Nothing was found";
    figure.diagonal = true;
    figure.series.push_back({.name = "none", .x = {1, 2}, .y = {nan, nan}, .error = {nan, 1}});
    figure.series.push_back({.name = "empty"});
    EXPECT_THAT(read_text(draw_figure(figure, folder.path(), "empty").svg),
                HasSubstr("<text>no data</text>"));
}

TEST(Figure, OfEveryKindIsDrawn) {
    const test::TemporaryFolder folder;
    using Kind = SeriesStyle::Kind;
    for (const bool logarithmic : {false, true}) {
        for (const bool hollow : {false, true}) {
            Figure figure;
            figure.log_x = figure.log_y = logarithmic;
            figure.equal_axes = !logarithmic;
            figure.diagonal = true;
            for (const Kind kind : {Kind::line_and_points, Kind::points, Kind::line, Kind::bars, Kind::steps})
                figure.series.push_back({.name = "kind",
                                         .x = {1, 2, 3},
                                         .y = {1, 3, 2},
                                         .low = {0.5, 2, 1},
                                         .high = {2, 4, 3},
                                         .style = {.kind = kind, .dashed = hollow, .hollow = hollow}});
            figure.series.push_back({.x = {2}, .y = {2}, .style = {.colour = SeriesStyle::neutral}});
            figure.series.push_back({.x = {2}, .y = {2}, .style = {.faint = true}});
            const DrawnFigure drawn = draw_figure(figure, folder.path(), "every");
            const std::string svg = read_text(drawn.svg);
            EXPECT_EQ(test::fault_in_markup(svg), "");
            EXPECT_THAT(svg, Not(HasSubstr("no data")));
            const cv::Mat png = cv::imread(drawn.png.string());
            EXPECT_EQ(png.cols, 2 * figure.width);
            // Each kind in the next colour of the palette; bars are pale where they are filled.
            EXPECT_THAT(svg, HasSubstr("rgb(204, 121, 167)"));
            for (const auto& [r, g, b] :
                 std::vector<std::array<int, 3>>{{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {230, 159, 0}})
                EXPECT_GT(pixels_like(png, r, g, b), 200)
                    << r << ' ' << g << ' ' << b << (logarithmic ? ", log" : "")
                    << (hollow ? ", hollow" : "");
        }
    }
}

TEST(Figure, OfAConstantIsDrawn) {
    const test::TemporaryFolder folder;
    Figure figure;
    figure.series.push_back({.name = "always 0", .x = {5}, .y = {0}});
    const std::string svg = read_text(draw_figure(figure, folder.path(), "zero").svg);
    EXPECT_EQ(test::fault_in_markup(svg), "");
    EXPECT_EQ(count(svg, "<use xlink:href='#gpPt6' transform"), 2u) << "the point and its like in the legend";
}

TEST(FieldFigure, ShowsLinesGoalsAndPaths) {
    const test::TemporaryFolder folder;
    Figure figure = field_figure(Field{}, "Walks");
    figure.series.push_back(path_series({{0, 0, 0}, {0.1, 0, 0}, {2, 1, 0}}, "path", {}));
    EXPECT_TRUE(std::isnan(figure.series.back().x.at(2))) << "a jump is no part of a path";
    EXPECT_EQ(figure.series.back().x.size(), 4u);
    const DrawnFigure drawn = draw_figure(figure, folder.path(), "walks");
    const cv::Mat png = cv::imread(drawn.png.string());
    EXPECT_GT(pixels_like(png, 31, 35, 40), 1500);
    const cv::Mat field = cv::imread(draw_figure(field_figure(Field{}, "Walks"), folder.path(), "f").png);
    Figure nothing;
    nothing.title = "Walks";
    const cv::Mat bare = cv::imread(draw_figure(nothing, folder.path(), "n").png);
    const auto path_pixels = [](const cv::Mat& picture) { return pixels_like(picture, 0, 114, 178); };
    EXPECT_EQ(path_pixels(field), 0);
    EXPECT_GT(path_pixels(png), 50) << "the path";
    EXPECT_GT(drawn_pixels(field), drawn_pixels(bare) + 5000) << "lines, circle and goals";
}

TEST(Gnuplot, MissingIsOneSentenceThatNamesThePackage) {
    const test::TemporaryFolder folder;
    const test::PathVariable nowhere(folder.path().string());
    const std::string expected =
        "the figures are drawn by gnuplot, which is not installed: sudo apt-get install gnuplot-nox";
    EXPECT_EQ(message_of([] { expect_gnuplot(); }), "--report: " + expected);
    EXPECT_EQ(message_of([&] { draw_figure(two_curves(), folder.path(), "rate"); }), expected);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Gnuplot, ThatIsThereIsAccepted) {
    EXPECT_NO_THROW(expect_gnuplot());
}

TEST(Gnuplot, ThatFailsTellsWhatItSaid) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(message_of([&] { run_gnuplot("set terminal nonsense\n", folder.path()); }),
                testing::AllOf(HasSubstr("gnuplot failed: "), HasSubstr("unknown or ambiguous terminal")));
    const test::TemporaryFolder programs;
    test::write_program(programs.path(), "gnuplot", "echo 'line 3: no such' >&2\necho ' font'\nexit 4\n");
    const test::PathVariable other(programs.path().string());
    EXPECT_EQ(message_of([&] { run_gnuplot("", folder.path()); }), "gnuplot failed: line 3: no such font");
}

TEST(Gnuplot, ThatWritesNothingIsNotBelieved) {
    const test::TemporaryFolder folder;
    const test::TemporaryFolder programs;
    test::write_program(programs.path(), "gnuplot", "exit 0\n");
    const test::PathVariable other(programs.path().string());
    EXPECT_THAT(message_of([&] { draw_figure(two_curves(), folder.path(), "rate"); }),
                HasSubstr("gnuplot wrote no figure"));
}

TEST(Gnuplot, ThatHangsIsEnded) {
    const test::TemporaryFolder folder;
    const test::TemporaryFolder programs;
    test::write_program(programs.path(), "gnuplot", "exec /bin/sleep 600\n");
    const test::PathVariable other(programs.path().string());
    EXPECT_EQ(message_of([&] { run_gnuplot("", folder.path(), std::chrono::milliseconds(200)); }),
              "gnuplot did not end within 0.2 s");
}

TEST(Figure, IntoAFolderThatIsNotThereNamesIt) {
    EXPECT_THAT(message_of([] { draw_figure(two_curves(), "/nonexistent/report", "rate"); }),
                HasSubstr("/nonexistent/report"));
}

}  // namespace
}  // namespace goalmouth
