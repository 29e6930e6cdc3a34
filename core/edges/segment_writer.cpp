#include "core/edges/segment_writer.h"

#include "core/edges/line_writer.h"
#include "core/edges/pair_mean.h"
#include "core/segmentation/label_changes.h"
#include "core/segmentation/pixel_labels.h"

#include <algorithm>
#include <cmath>
#include <hwy/cache_control.h>

namespace goalmouth {

void SegmentWriter::write(YuyvView image, const FrameContent& content, Segments& out) {
    write_rows(image, content, out);
    write_columns(image, content, out);
}

void SegmentWriter::write_rows(YuyvView image, const FrameContent& content, Segments& out) {
    const auto first_pixel = [&](float x) {
        return std::clamp(static_cast<int>(std::lround(x + 0.5F)), 1, image.width - 1);
    };
    changed_.resize(content.columns.size() + label_margin);
    auto run = content.runs.begin();
    for (std::size_t row = 0; row < content.rows.size(); ++row) {
        const std::uint8_t* ground = content.ground.row(row);
        const std::size_t changes =
            content.columns.empty()
                ? 0
                : find_changes(ground, ground + 1, content.columns.size() - 1, changed_.data());
        LineWriter line(out, Orientation::horizontal, content.rows[row]);
        Colour colour = !content.columns.empty() && ground[0] != 0 ? Colour::field : Colour::unclassified;
        line.change(0, colour);
        const auto write_run = [&] {
            // What goes on beyond the picture has no edge at its border.
            if (run->left < 0.5F) {
                line.change(0, Colour::goal);
            } else {
                line.change(first_pixel(run->left), Colour::goal, run->left);
            }
            if (run->right < static_cast<float>(image.width) - 1.5F)
                line.change(first_pixel(run->right), colour, run->right);
            ++run;
        };
        const auto of_row = [&] { return run != content.runs.end() && run->row == row; };
        for (std::size_t k = 0; k < changes; ++k) {
            const auto c = static_cast<std::size_t>(changed_[k]);
            const int start = (content.columns[c] + content.columns[c + 1] + 1) / 2;
            while (of_row() && first_pixel(run->right) <= start) write_run();
            colour = colour == Colour::field ? Colour::unclassified : Colour::field;
            if (!of_row() || first_pixel(run->left) > start) line.change(start, colour);
        }
        while (of_row()) write_run();
        line.end(image.width);
    }
}

/// Where the field begins in each column whose border lies between two rows: the first pixel that is the
/// field's, by halves. All columns take their halves together, so that the memory of the next one is on its
/// way.
void SegmentWriter::locate_border(YuyvView image, const FrameContent& content) {
    const auto ask_for = [&](const BorderPlace& p) {
        hwy::Prefetch(image.row((p.upper + p.lower) / 2) + 4 * (content.columns[p.column] / 2));
    };
    const int last_pair = (image.width - 1) / 2;
    for (const BorderPlace& place : border_) ask_for(place);
    for (bool more = true; more;) {
        more = false;
        for (BorderPlace& place : border_) {
            if (place.lower - place.upper <= 1) continue;
            const int middle = (place.upper + place.lower) / 2;
            const int pair = content.columns[place.column] / 2;
            const bool field = content.field->contains(
                mean_of_pairs(image.row(middle), pair, std::min(pair + 1, last_pair)));
            (field ? place.lower : place.upper) = middle;
            ask_for(place);
            more = true;
        }
    }
}

void SegmentWriter::write_columns(YuyvView image, const FrameContent& content, Segments& out) {
    const std::size_t columns = content.columns.size();
    const std::size_t rows = content.rows.size();
    constexpr auto goal = static_cast<std::uint8_t>(Colour::goal);
    static_assert(static_cast<int>(Colour::field) == 1 && static_cast<int>(Colour::unclassified) == 0);
    labels_.assign(content.ground.row(0), content.ground.row(rows) + label_margin);
    for (const GoalRun& run : content.runs) {
        const auto begin = std::lower_bound(content.columns.begin(), content.columns.end(), run.left,
                                            [](int x, float left) { return static_cast<float>(x) < left; });
        for (auto x = begin; x != content.columns.end() && static_cast<float>(*x) < run.right; ++x)
            labels_[run.row * columns + static_cast<std::size_t>(x - content.columns.begin())] = goal;
    }
    // Row by row, as memory lies, then by column.
    changes_.clear();
    first_change_.assign(columns + 1, 0);
    for (std::size_t row = 1; row < rows; ++row) {
        const std::uint8_t* here = labels_.data() + row * columns;
        const std::size_t count = find_changes(here - columns, here, columns, changed_.data());
        for (std::size_t k = 0; k < count; ++k) {
            const auto column = static_cast<std::size_t>(changed_[k]);
            changes_.push_back({row, column});
            ++first_change_[column + 1];
        }
    }
    for (std::size_t c = 0; c < columns; ++c) first_change_[c + 1] += first_change_[c];
    sorted_.resize(changes_.size());
    for (const ColumnChange& change : changes_) sorted_[first_change_[change.column]++] = change;

    border_.clear();
    const auto label_at = [&](std::size_t row, std::size_t column) {
        return static_cast<Colour>(labels_[row * columns + column]);
    };
    // To the pixel where it matters: where the field begins for the first time, but not behind a post.
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        const auto& [row, column] = sorted_[i];
        if (label_at(row, column) != Colour::field || label_at(0, column) == Colour::field) continue;
        if (!border_.empty() && border_.back().column == column) continue;
        border_.push_back({column, i, content.rows[row - 1], content.rows[row]});
    }
    std::erase_if(border_, [&](const BorderPlace& place) {
        const ColumnChange& change = sorted_[place.change];
        return label_at(change.row - 1, change.column) == Colour::goal;
    });
    locate_border(image, content);

    auto place = border_.begin();
    auto change = sorted_.begin();
    for (std::size_t c = 0; c < columns; ++c) {
        LineWriter line(out, Orientation::vertical, content.columns[c]);
        line.change(0, rows > 0 ? label_at(0, c) : Colour::unclassified);
        for (; change != sorted_.end() && change->column == c; ++change) {
            int start = (content.rows[change->row - 1] + content.rows[change->row] + 1) / 2;
            if (place != border_.end() && place->change == static_cast<std::size_t>(change - sorted_.begin()))
                start = (place++)->lower;
            line.change(start, label_at(change->row, c));
        }
        line.end(image.height);
    }
}

}  // namespace goalmouth
