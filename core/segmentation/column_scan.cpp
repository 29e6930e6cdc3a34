#include "core/segmentation/column_scan.h"

#include "core/segmentation/label_changes.h"

#include <algorithm>
#include <cassert>

namespace goalmouth {
namespace {

/// A segment as long as this is as good as any longer one to the transition it starts with.
constexpr int long_enough = 5;  // px

/// How far above a change its window may begin.
constexpr int window_above = 3;  // px

static_assert(ColumnScan::largest_band + long_enough + 2 * window_above <= band_height);

}  // namespace

void ColumnScan::reserve(std::size_t count) {
    if (label_.size() >= count) return;
    count = std::max(count, 2 * label_.size());
    label_.resize(count);
    column_.resize(count);
    for (auto* array :
         {&changes_.y, &changes_.pair, &changes_.odd, &changes_.length_before, &changes_.length_after})
        array->resize(count + transition_margin);
    changes_.transition.resize(count + transition_margin);
}

void ColumnScan::begin(YuyvView image, const std::vector<int>& columns) {
    image_ = image;
    positions_ = columns;
    columns_.assign(columns);
    next_y_ = 0;
    count_ = 0;
    const std::size_t n = columns.size();
    labels_.resize(std::max(labels_.size(), n * (largest_band + 1) + 2 * label_margin));
    changed_.resize(std::max(changed_.size(), n * largest_band));
    latest_.assign(n, -1);
    segments_.assign(n, 0);
    located_ = n;
}

/// The segment that starts at (column, y); the column's last one ends there.
void ColumnScan::record(std::int32_t y, std::size_t column, std::uint8_t label) {
    const std::size_t i = count_++;
    label_[i] = label;
    column_[i] = static_cast<std::int32_t>(column);
    changes_.y[i] = y;
    changes_.pair[i] = columns_.pair()[column];
    changes_.odd[i] = columns_.odd()[column];
    changes_.length_after[i] = image_.height - y;  // until another one follows
    if (y > 0) {
        const auto before = static_cast<std::size_t>(latest_[column]);
        changes_.length_before[i] = changes_.length_after[before] = y - changes_.y[before];
    }
    latest_[column] = static_cast<std::int32_t>(i);
    ++segments_[column];
}

void ColumnScan::scan(const LabelTable& table, int rows) {
    assert(rows >= 1 && rows <= largest_band && next_y_ + rows <= image_.height);
    const std::size_t n = positions_.size();
    if (n == 0) return;
    std::uint8_t* const before = labels_.data();
    std::uint8_t* const labels = before + n;
    reserve(count_ + n * static_cast<std::size_t>(rows + 1));
    label_columns(table, image_, next_y_, rows, columns_, labels);
    if (next_y_ == 0) {
        std::copy_n(labels, n, before);
        for (std::size_t column = 0; column < n; ++column) record(0, column, labels[column]);
    }

    const std::size_t found =
        find_changes(labels, before, n * static_cast<std::size_t>(rows), changed_.data());
    std::size_t row_start = 0;
    int y = next_y_;
    for (std::size_t i = 0; i < found; ++i) {
        const auto at = static_cast<std::size_t>(changed_[i]);
        for (; at >= row_start + n; row_start += n) ++y;
        record(y, at - row_start, labels[at]);
    }
    std::copy_n(labels + n * static_cast<std::size_t>(rows - 1), n, before);
    next_y_ += rows;
    locate(next_y_ == image_.height ? image_.height - 1 : next_y_ - long_enough);
}

/// Locates the transitions of what starts at last_y or above and was not located before.
void ColumnScan::locate(int last_y) {
    std::size_t end = located_;
    while (end < count_ && changes_.y[end] <= last_y) ++end;
    if (end == located_) return;
    const int from_y = std::max(0, changes_.y[located_] - window_above);
    locate_column_transitions(image_, from_y, located_, end, changes_);
    located_ = end;
}

void ColumnScan::append_to(Segments& out) {
    assert(positions_.empty() || next_y_ == image_.height);
    auto first = static_cast<int>(out.segments.size());
    for (std::size_t column = 0; column < positions_.size(); ++column) {
        out.lines.push_back({Orientation::vertical, positions_[column], first, segments_[column]});
        latest_[column] = first;  // from here on: where its next segment goes
        first += segments_[column];
    }
    out.segments.resize(static_cast<std::size_t>(first));
    for (std::size_t i = 0; i < count_; ++i) {
        const std::int32_t y = changes_.y[i];
        Segment& segment =
            out.segments[static_cast<std::size_t>(latest_[static_cast<std::size_t>(column_[i])]++)];
        segment = {static_cast<std::int16_t>(y), static_cast<std::int16_t>(y + changes_.length_after[i] - 1),
                   static_cast<Colour>(label_[i]), y == 0 ? -0.5F : changes_.transition[i]};
    }
}

}  // namespace goalmouth
