#include "core/edges/ground.h"

#include "core/edges/pair_mean.h"
#include "core/edges/row_vectors.h"
#include "core/geometry/convex_hull.h"
#include "core/segmentation/pixel_labels.h"

#include <algorithm>

namespace goalmouth {

void Ground::begin(YuyvView image, const std::vector<int>& rows, const std::vector<int>& columns) {
    image_ = image;
    rows_ = &rows;
    columns_ = &columns;
    rows_seen_ = 0;
    mask_.assign(rows.size() * columns.size() + std::max(label_margin, row_margin), 0);
    hull_.clear();
    pairs_.clear();
    // Each with its right neighbour, the picture's last one with its left one.
    for (const int x : columns) pairs_.push_back(std::max(0, std::min(x / 2, (image.width - 1) / 2 - 1)));
}

void Ground::add_row(const FieldColour& field) {
    const std::uint8_t* row = image_.row((*rows_)[rows_seen_]);
    std::uint8_t* mask = mask_.data() + rows_seen_ * columns_->size();
    ++rows_seen_;
    if (image_.width > 2) {
        find_field(row, pairs_.data(), columns_->size(), field, mask);
    } else {
        std::fill_n(mask, columns_->size(), field.contains(mean_of_pairs(row, 0, 0)) ? 1 : 0);
    }
}

void Ground::finish() {
    const std::size_t columns = columns_->size();
    begins_.resize(columns + row_margin);
    find_ground(mask_.data(), rows_seen_, columns, begins_.data());
    points_.clear();
    for (std::size_t c = 0; c < columns; ++c) {
        const auto begins = static_cast<std::size_t>(begins_[c]);
        if (begins < rows_seen_) points_.emplace_back((*columns_)[c], (*rows_)[begins]);
    }
    upper_hull(points_, hull_);
}

double Ground::border_at(double x) const {
    return chain_y_at(hull_, x);
}

}  // namespace goalmouth
