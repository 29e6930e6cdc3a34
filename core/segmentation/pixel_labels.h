#pragma once

#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>
#include <hwy/aligned_allocator.h>
#include <vector>

namespace goalmouth {

/// A colour table as the scan reads it: the same entries in the same order, from a cache line's border on, so
/// that a chroma's luma profile lies in one line (6 bits), followed by a few bytes that a vector's look-up of
/// four bytes may touch beyond the last entry.
class LabelTable {
  public:
    explicit LabelTable(const ColourTable& table);

    int bits() const { return bits_; }
    const std::uint8_t* entries() const { return entries_.get(); }

  private:
    int bits_;
    hwy::AlignedFreeUniquePtr<std::uint8_t[]> entries_;
};

/// The columns of a layout as the scan reads them.
class LabelColumns {
  public:
    void assign(const std::vector<int>& columns);  // px, each inside the image

    std::size_t size() const { return size_; }
    const std::int32_t* pair() const { return pair_.data(); }  // bytes from the row's start to its pair
    const std::int32_t* odd() const { return odd_.data(); }    // −1 where it is its pair's second, else 0
    std::size_t in_a_cache_line() const { return in_a_cache_line_; }  // about, at least 1

  private:
    std::size_t size_ = 0;
    std::size_t in_a_cache_line_ = 1;
    std::vector<std::int32_t> pair_;  // a vector longer than size_, the rest naming the first pair
    std::vector<std::int32_t> odd_;
};

/// Labels are written in whole vectors: so many bytes behind the last one are overwritten with anything.
inline constexpr std::size_t label_margin = 64;

/// Labels of all `pairs` 4:2:2 pairs of a row, two a pair.
void label_row(const LabelTable& table, const std::uint8_t* row, std::size_t pairs, std::uint8_t* labels);

/// Labels of the columns in the rows y … y + rows − 1: labels[r · columns.size() + c].
void label_columns(const LabelTable& table, YuyvView image, int y, int rows, const LabelColumns& columns,
                   std::uint8_t* labels);

}  // namespace goalmouth
