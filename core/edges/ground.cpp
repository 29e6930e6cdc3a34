#include "core/edges/ground.h"

#include "core/geometry/convex_hull.h"
#include "core/segmentation/pixel_labels.h"

#include <algorithm>

namespace goalmouth {

void Ground::begin(const std::vector<int>& rows, const std::vector<int>& columns) {
    rows_ = &rows;
    columns_ = &columns;
    rows_seen_ = 0;
    mask_.assign(rows.size() * columns.size() + label_margin, 0);
    hull_.clear();
}

void Ground::add_row(ChromaRow& row, const FieldColour& field) {
    std::uint8_t* mask = mask_.data() + rows_seen_++ * columns_->size();
    const auto is_field = row.is_field(field);
    for (const int x : *columns_) *mask++ = is_field[static_cast<std::size_t>(x / 2)];
}

void Ground::finish() {
    const std::size_t columns = columns_->size();
    sum_.assign(columns, 0);
    most_.assign(columns, 0);
    begins_.assign(columns, static_cast<std::int32_t>(rows_->size()));
    for (std::size_t r = rows_seen_; r-- > 0;) {
        const std::uint8_t* mask = mask_.data() + r * columns;
        for (std::size_t c = 0; c < columns; ++c) {
            sum_[c] += mask[c] ? 2 : -1;
            const bool more = sum_[c] > most_[c];
            most_[c] = more ? sum_[c] : most_[c];
            begins_[c] = more ? static_cast<std::int32_t>(r) : begins_[c];
        }
    }
    points_.clear();
    for (std::size_t c = 0; c < columns; ++c) {
        const auto begins = static_cast<std::size_t>(begins_[c]);
        for (std::size_t r = 0; r < std::min(begins, rows_seen_); ++r) mask_[r * columns + c] = 0;
        if (begins < rows_seen_) points_.emplace_back((*columns_)[c], (*rows_)[begins]);
    }
    upper_hull(points_, hull_);
}

double Ground::border_at(double x) const {
    return chain_y_at(hull_, x);
}

}  // namespace goalmouth
