#pragma once

#include "core/edges/appearance.h"
#include "core/edges/chroma_row.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace goalmouth {

/// A stretch of a row of a 4:2:2 frame, one sample for each pair of pixels, to be looked at closely. Pairs
/// are counted from the row's start. Keeps its memory; the results are the same with all kinds of vector
/// instructions, bit by bit.
class RowStretch {
  public:
    /// Reads what the row y has of the pairs first … end − 1.
    void load(YuyvView image, int y, int first, int end);

    /// The same stretch of another row will be wanted soon.
    void ask_for(YuyvView image, int y) const;

    int first() const { return first_; }
    int end() const { return end_; }
    /// Mean of the pairs first … last; what of them lies beyond the stretch is left out. Nothing left: zero.
    Appearance mean(int first, int last) const;

    /// For each box of `window` ≤ widest_window pairs, the first of which is first … last: how unlike
    /// `surface` its mean looks [grey levels] (appearance.h). The boxes have to lie in the stretch. Valid
    /// until the next call.
    std::span<const float> unlikeness(int first, int last, int window, const Appearance& surface,
                                      float chroma_weight);

    /// Where a sharp step from a to b would have the same sum of shares of b as the pixels on `reach` pairs
    /// on either side of pair `pair`'s left border [px]. What lies beyond the stretch is left out. a and b
    /// must differ.
    double step_place(int pair, int reach, const Appearance& a, const Appearance& b) const;

  private:
    int width_ = 0;  // px, of the row
    int first_ = 0, end_ = 0;
    std::vector<std::uint8_t> bytes_;        // the stretch, each of these arrays
    std::vector<std::int16_t> y_, cb_, cr_;  // with row_margin entries behind it
    std::vector<float> unlike_;
};

}  // namespace goalmouth
