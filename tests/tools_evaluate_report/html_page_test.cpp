#include "tools/evaluate/report/html_page.h"

#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/well_formed.h"

#include <limits>
#include <regex>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace goalmouth {
namespace {

using testing::HasSubstr;
using testing::Not;

Table small_table() {
    return {
        .caption = "Errors",
        .columns = {"detector", "RMSE [cm]", "posts"},
        .rows = {{"RANSAC", {12.345, 1, Cell::Mark::good}, {400, 0}},
                 {"histogram", {-0.04, 1, Cell::Mark::bad}, {std::numeric_limits<double>::quiet_NaN(), 0}}},
        .groups = {{"", 1}, {"scene flat", 2}},
        .good = "within 31 cm",
        .bad = "more"};
}

/// Everything a page can hold.
HtmlPage full_page() {
    const test::TemporaryFolder folder;
    Figure figure;
    figure.series.push_back({.name = "a", .x = {1, 2}, .y = {3, 4}});
    const cv::Mat picture(48, 64, CV_8UC3, cv::Scalar(10, 200, 30));
    HtmlPage page("Title <1>", "Lead & more");
    page.section("One").paragraph("a < b").note("n").list({"x", "<y>"}).definitions({{"seed", "1"}});
    page.subsection("Sub").code("goalmouth evaluate paper \\\n  --seed 1").table(small_table());
    page.section("Two").figure(draw_figure(figure, folder.path(), "one"), "first & only");
    page.figures({draw_figure(figure, folder.path(), "two"), draw_figure(figure, folder.path(), "three")},
                 "");
    page.pictures({page_picture(picture, "\"one\""), page_picture(picture, "two", PictureFormat::png)});
    page.picture(page_picture(picture, ""));
    page.details("All <cells>", [](HtmlPage& inner) { inner.table(small_table()); });
    return page;
}

TEST(HtmlPage, IsWellFormed) {
    const std::string html = full_page().html();
    EXPECT_EQ(test::fault_in_markup(html), "");
    EXPECT_EQ(test::repeated_id(html), "");
    EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0u);
    EXPECT_THAT(html, HasSubstr("<meta charset=\"utf-8\">"));
}

TEST(HtmlPage, NeedsNothingBesideItself) {
    const std::string html = full_page().html();
    EXPECT_THAT(html, Not(HasSubstr("http:")));
    EXPECT_THAT(html, Not(HasSubstr("https:")));
    EXPECT_THAT(html, Not(HasSubstr("@import")));
    static const std::regex source(R"re((src|href|url)\s*[=(]\s*["']?([^"' >)]*))re");
    int sources = 0;
    for (auto it = std::sregex_iterator(html.begin(), html.end(), source); it != std::sregex_iterator();
         ++it) {
        const std::string where = (*it)[2];
        EXPECT_TRUE(where.rfind("data:image/", 0) == 0 || where.rfind("#", 0) == 0) << where.substr(0, 80);
        ++sources;
    }
    EXPECT_GE(sources, 3);
}

TEST(HtmlPage, EscapesEveryText) {
    const std::string bad = "<script>\"&'\xFF";
    const std::string good = "&lt;script&gt;&quot;&amp;&#39;\xEF\xBF\xBD";
    HtmlPage page(bad, bad);
    page.section(bad)
        .subsection(bad)
        .paragraph(bad)
        .note(bad)
        .list({bad})
        .definitions({{bad, bad}})
        .code(bad);
    page.table(
        {.caption = bad, .columns = {bad}, .rows = {{bad}}, .groups = {{bad, 1}}, .good = bad, .bad = bad});
    page.picture(page_picture(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(9)), bad)).section("end");
    page.details(bad, [&](HtmlPage& inner) { inner.paragraph(bad); });
    const std::string html = page.html();
    EXPECT_THAT(html, Not(HasSubstr("<script>")));
    // title twice, lead, the section and its entry, 6 blocks of which one has two, 6 in the table, 2, 2
    EXPECT_EQ(test::count(html, good), 22u);
    EXPECT_EQ(test::fault_in_markup(html), "");
}

TEST(HtmlPage, ListsItsSections) {
    const std::string html =
        HtmlPage("t", "").section("Worst failures: RANSAC").section("Worst failures, RANSAC").html();
    EXPECT_THAT(html, HasSubstr("<a href=\"#worst-failures-ransac\">Worst failures: RANSAC</a>"));
    EXPECT_THAT(html, HasSubstr("<h2 id=\"worst-failures-ransac\">"));
    EXPECT_THAT(html, HasSubstr("<a href=\"#worst-failures-ransac-2\">"));
    EXPECT_THAT(HtmlPage("t", "").section("only one").html(), Not(HasSubstr("<nav")));
    EXPECT_THAT(HtmlPage("t", "").section("any", "chosen").html(), HasSubstr("<h2 id=\"chosen\">"));
}

TEST(HtmlPage, LetsAPictureOfAGridBeSeenLarge) {
    PagePicture picture = page_picture(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(9)), "caption");
    picture.hint = "frame <7>";
    const std::string html = HtmlPage("t", "").pictures({picture, picture}).picture(picture).html();
    EXPECT_EQ(test::count(html, "<label class=\"zoom\"><input type=\"checkbox\""), 2u);
    EXPECT_EQ(test::count(html, "<figure><img "), 1u) << "alone it is large as it is";
    EXPECT_EQ(test::count(html, " title=\"frame &lt;7&gt;\""), 3u);
    EXPECT_THAT(html, HasSubstr(".zoom input:checked + img"));
    EXPECT_THAT(html, Not(HasSubstr("decoding=\"async\""))) << "pictures would be missing in print";
}

TEST(HtmlPage, RefusesASectionInsideDetails) {
    HtmlPage page("t", "");
    EXPECT_THROW(page.details("s", [](HtmlPage& inner) { inner.section("hidden"); }), std::logic_error);
}

TEST(HtmlTable, SetsNumbersRightWithTheirDecimals) {
    const std::string html = table_html(small_table());
    EXPECT_THAT(html, HasSubstr("<td class=\"n good\">12.3</td>"));
    EXPECT_THAT(html, HasSubstr("<td class=\"n bad\">0.0</td>")) << "no minus before zero";
    EXPECT_THAT(html, HasSubstr("<td class=\"n\">–</td>")) << "not a number";
    EXPECT_THAT(html, HasSubstr("<th scope=\"row\">RANSAC</th>"));
    EXPECT_THAT(html, HasSubstr("<th scope=\"col\" class=\"n\">posts</th>"));
    EXPECT_THAT(html, HasSubstr("colspan=\"2\">scene flat</th>"));
    EXPECT_THAT(html, HasSubstr("<span class=\"good\">within 31 cm</span>"));
    EXPECT_EQ(test::fault_in_markup(html), "");
}

TEST(HtmlTable, WritesMinusAndDeviation) {
    EXPECT_EQ(Cell(-12.34, 1).text, "−12.3");
    EXPECT_EQ(Cell(-1e-9, 3).text, "0.000");
    EXPECT_EQ(Cell::with_deviation(1.0, 0.25, 2).text, "1.00 ± 0.25");
    EXPECT_EQ(Cell(std::numeric_limits<double>::infinity(), 1).text, "–");
}

TEST(HtmlTable, RefusesRowsOfAnotherWidth) {
    Table table = small_table();
    table.rows.push_back({"short"});
    EXPECT_THROW(table_html(table), std::invalid_argument);
    table = small_table();
    table.groups = {{"too wide", 9}};
    EXPECT_THROW(table_html(table), std::invalid_argument);
}

TEST(PagePicture, IsMadeSmallerWhereItIsTooWide) {
    const PagePicture picture = page_picture(cv::Mat(1200, 1600, CV_8UC1, cv::Scalar(90)), "c");
    EXPECT_EQ(picture.width, 960);
    EXPECT_EQ(picture.height, 720);
    EXPECT_EQ(picture.uri.rfind("data:image/jpeg;base64,/9j/", 0), 0u);
    EXPECT_THROW(page_picture(cv::Mat(), "c"), std::invalid_argument);
    EXPECT_THROW(page_picture(cv::Mat(4, 4, CV_32FC1, cv::Scalar(0)), "c"), std::invalid_argument);
}

TEST(PagePicture, OfAFileIsItsBytes) {
    const test::TemporaryFolder folder;
    test::write_grey_picture(folder.path() / "grey.png", 80, 20, 10);
    const PagePicture picture = page_picture(folder.path() / "grey.png", "c");
    EXPECT_EQ(picture.width, 20);
    EXPECT_EQ(picture.height, 10);
    EXPECT_EQ(picture.uri.rfind("data:image/png;base64,iVBORw0KGgo", 0), 0u);
    const std::size_t bytes = std::filesystem::file_size(folder.path() / "grey.png");
    EXPECT_EQ(picture.uri.size(), std::string("data:image/png;base64,").size() + (bytes + 2) / 3 * 4);
}

TEST(PagePicture, OfAFileThatIsNoneNamesIt) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "text.png";
    test::write_text(file, "no picture");
    for (const auto& bad : {file, folder.path() / "missing.jpg"}) {
        try {
            page_picture(bad, "c");
            FAIL() << bad;
        } catch (const ConfigurationError& error) {
            EXPECT_THAT(error.what(), HasSubstr(bad.string()));
        }
    }
}

}  // namespace
}  // namespace goalmouth
