#pragma once

#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// Entries that must follow the last one in every array below: whole vectors are read and written.
inline constexpr std::size_t transition_margin = 16;

/// Transitions of a row's `count` ≥ 1 segments, as locate_transition() finds them, limited and rounded as
/// segmentation.h says. `starts`: their starts and then the image's width.
void locate_row_transitions(const std::uint8_t* row, int width, std::size_t count, const std::int32_t* starts,
                            float* transitions);

/// Changes of the class down columns, an array for each of their properties.
struct ColumnChanges {
    std::vector<std::int32_t> y;              // px, the new segment's first row, ≥ 1
    std::vector<std::int32_t> pair;           // bytes from a row's start to the column's pair
    std::vector<std::int32_t> odd;            // −1 where the column is its pair's second pixel, else 0
    std::vector<std::int32_t> length_before;  // px, of the segment that ends there
    std::vector<std::int32_t> length_after;   // px, of the one that starts there; 5 or more are all the same
    std::vector<float> transition;            // px along the column
};

/// Rows that changes located together may span, with what their windows need above and below.
inline constexpr int band_height = 64;

/// Transitions of the changes first … last − 1, whose windows all lie within band_height rows from `from_y`.
void locate_column_transitions(YuyvView image, int from_y, std::size_t first, std::size_t last,
                               ColumnChanges& changes);

}  // namespace goalmouth
