#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace goalmouth {

/// One cell of a table: text, or a number that is set right-aligned.
struct Cell {
    enum class Mark { none, strong, good, bad };

    Cell(std::string text_) : text(std::move(text_)) {}  // implicit: rows are written {"RANSAC", {0.31, 2}}
    Cell(const char* text_) : text(text_) {}
    /// With so many decimals, and a true minus; an en dash where it is not finite.
    Cell(double value, int decimals, Mark mark_ = Mark::none);
    Cell(std::string text_, Mark mark_) : text(std::move(text_)), mark(mark_) {}
    /// Mean ± deviation.
    static Cell with_deviation(double mean, double deviation, int decimals, Mark mark = Mark::none);

    std::string text;
    bool number = false;
    Mark mark = Mark::none;
};

struct ColumnGroup {
    std::string title;
    std::size_t columns = 1;
};

struct Table {
    std::string caption = {};
    std::vector<std::string> columns = {};
    std::vector<std::vector<Cell>> rows = {};  // each as long as columns; its first cell names the row
    std::vector<ColumnGroup> groups = {};      // a line above the header; together as wide as columns
    std::string good = {};                     // what the marks mean, for the legend below: "within 31 cm"
    std::string bad = {};
};

/// The table as HTML. Throws std::invalid_argument where a row or the groups are not as wide as the columns.
std::string table_html(const Table& table);

}  // namespace goalmouth
