#include "tools/evaluate/report/html_table.h"

#include "tools/evaluate/report/html_page.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace goalmouth {
namespace {

std::string number_text(double value, int decimals) {
    if (!std::isfinite(value)) return "–";
    std::string text = fmt::format("{:.{}f}", value, std::max(decimals, 0));
    const bool zero = text.find_first_not_of("-0.") == std::string::npos;
    if (text.front() == '-') text = (zero ? "" : "−") + text.substr(1);
    return text;
}

/// "n" for numbers, and the mark's own.
std::string class_of(const Cell& cell) {
    std::string name = cell.number ? "n" : "";
    const auto add = [&](const char* mark) { name += (name.empty() ? "" : " ") + std::string(mark); };
    if (cell.mark == Cell::Mark::strong) add("strong");
    if (cell.mark == Cell::Mark::good) add("good");
    if (cell.mark == Cell::Mark::bad) add("bad");
    return name.empty() ? "" : " class=\"" + name + "\"";
}

/// Columns of numbers have their header on the right, over the numbers.
bool is_number_column(const Table& table, std::size_t column) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const std::vector<Cell>& row) { return row[column].number; });
}

std::string legend_of(const Table& table) {
    std::string legend;
    if (!table.good.empty()) legend += "<span class=\"good\">" + escape_html(table.good) + "</span>";
    if (!table.bad.empty())
        legend += (legend.empty() ? "" : " ") + ("<span class=\"bad\">" + escape_html(table.bad)) + "</span>";
    return legend.empty() ? "" : "<p class=\"legend\">" + legend + "</p>\n";
}

void check(const Table& table) {
    for (const std::vector<Cell>& row : table.rows) {
        if (row.size() != table.columns.size())
            throw std::invalid_argument(fmt::format("table '{}': a row of {} cells for {} columns",
                                                    table.caption, row.size(), table.columns.size()));
    }
    std::size_t wide = 0;
    for (const ColumnGroup& group : table.groups) wide += group.columns;
    if (!table.groups.empty() && wide != table.columns.size())
        throw std::invalid_argument(fmt::format("table '{}': groups of {} columns in all for {}",
                                                table.caption, wide, table.columns.size()));
}

}  // namespace

Cell::Cell(double value, int decimals, Mark mark_)
    : text(number_text(value, decimals)), number(true), mark(mark_) {}

Cell Cell::with_deviation(double mean, double deviation, int decimals, Mark mark) {
    Cell cell(mean, decimals, mark);
    if (std::isfinite(mean)) cell.text += " ± " + number_text(deviation, decimals);
    return cell;
}

std::string table_html(const Table& table) {
    check(table);
    std::string html = "<div class=\"wide\"><table>\n";
    if (!table.caption.empty()) html += "<caption>" + escape_html(table.caption) + "</caption>\n";
    html += "<thead>\n";
    if (!table.groups.empty()) {
        html += "<tr class=\"groups\">";
        for (const ColumnGroup& group : table.groups)
            html += fmt::format("<th scope=\"colgroup\" colspan=\"{}\">{}</th>", group.columns,
                                escape_html(group.title));
        html += "</tr>\n";
    }
    html += "<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        html += fmt::format("<th scope=\"col\"{}>{}</th>", is_number_column(table, i) ? " class=\"n\"" : "",
                            escape_html(table.columns[i]));
    html += "</tr>\n</thead>\n<tbody>\n";
    for (const std::vector<Cell>& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) {
            const char* tag = i == 0 ? "th" : "td";
            html += fmt::format("<{0}{1}{2}>{3}</{0}>", tag, i == 0 ? " scope=\"row\"" : "", class_of(row[i]),
                                escape_html(row[i].text));
        }
        html += "</tr>\n";
    }
    return html + "</tbody>\n</table></div>\n" + legend_of(table);
}

}  // namespace goalmouth
