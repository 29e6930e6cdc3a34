#pragma once

#include "core/edges/field_colour.h"
#include "core/edges/ground.h"
#include "core/imaging/yuyv.h"
#include "core/segmentation/segments.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace goalmouth {

/// Where a post lies on a scan-line.
struct GoalRun {
    std::size_t row;    // number of the scan-line
    float left, right;  // px
};

/// What was found in a frame.
struct FrameContent {
    const std::vector<int>& rows;     // px, ascending
    const std::vector<int>& columns;  // px, ascending
    const Ground& ground;
    const std::optional<FieldColour>& field;
    const std::vector<GoalRun>& runs;  // by row, from left to right
};

/// Puts what was found in a frame into segments, as EdgeSegmenter promises them. Keeps its memory.
class SegmentWriter {
  public:
    /// Appends the rows' lines, then the columns'.
    void write(YuyvView image, const FrameContent& content, Segments& out);

  private:
    void write_rows(YuyvView image, const FrameContent& content, Segments& out);
    void write_columns(YuyvView image, const FrameContent& content, Segments& out);
    void locate_border(YuyvView image, const FrameContent& content);

    /// A change down a column, before the row of that number.
    struct ColumnChange {
        std::size_t row;
        std::size_t column;
    };
    /// Of the changes in sorted_ that where the field begins in a column.
    struct BorderPlace {
        std::size_t column;
        std::size_t change;
        int upper, lower;  // px, rows above it and on it, closer and closer
    };
    std::vector<std::uint8_t> labels_;  // by row and column
    std::vector<std::int32_t> changed_;
    std::vector<ColumnChange> changes_, sorted_;
    std::vector<BorderPlace> border_;
    std::vector<std::size_t> first_change_;  // of each column in sorted_; one more at the end
};

}  // namespace goalmouth
