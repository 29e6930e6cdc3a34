#pragma once

#include "core/imaging/yuyv.h"
#include "core/segmentation/pixel_labels.h"
#include "core/segmentation/segments.h"
#include "core/segmentation/transitions.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// Cuts columns of a frame into segments, all at once in one walk down its rows: walking each column down
/// would touch a cache line for every pixel. The labels of a band of rows lie one row after the other and are
/// compared with themselves one row on; the changes found are kept in the order of rows and sorted by column
/// at the end. Keeps its memory from frame to frame.
class ColumnScan {
  public:
    /// Starts a frame. Columns are px inside the image, in any order.
    void begin(YuyvView image, const std::vector<int>& columns);

    /// The next `rows` rows, at most largest_band. Transitions are located as soon as their segments'
    /// lengths are known as far as they matter: while the rows around are still in cache.
    void scan(const LabelTable& table, int rows);
    static constexpr int largest_band = 32;

    /// After the last row: appends the columns' lines and segments.
    void append_to(Segments& out);

  private:
    void reserve(std::size_t count);
    void record(std::int32_t y, std::size_t column, std::uint8_t label);
    void locate(int last_y);

    YuyvView image_;
    std::vector<int> positions_;  // px
    LabelColumns columns_;
    int next_y_ = 0;

    std::vector<std::uint8_t> labels_;  // of the row before the band, then of the band's rows
    std::vector<std::int32_t> changed_;

    // Segments in the order of rows; those of y = 0 first, one a column.
    std::size_t count_ = 0;
    std::size_t located_ = 0;
    ColumnChanges changes_;
    std::vector<std::uint8_t> label_;
    std::vector<std::int32_t> column_;

    std::vector<std::int32_t> latest_;    // of each column: its last segment's number
    std::vector<std::int32_t> segments_;  // of each column: how many it has
};

}  // namespace goalmouth
