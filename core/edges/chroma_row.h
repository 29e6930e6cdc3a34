#pragma once

#include "core/edges/appearance.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// A row of a 4:2:2 frame in the resolution of its colour: one sample for each pair of pixels.
class ChromaRow {
  public:
    /// Reads row y.
    void load(YuyvView image, int y);

    int pairs() const { return pairs_; }
    Appearance at(int pair) const {
        const auto i = static_cast<std::size_t>(pair);
        return {0.5F * static_cast<float>(y_[i]), static_cast<float>(cb_[i] - 128),
                static_cast<float>(cr_[i] - 128)};
    }
    /// Mean of the pairs first … last; what of them lies beyond the row is left out. Nothing left: zero.
    Appearance mean(int first, int last) const;

    /// The row's derivative by two boxes: for each pair the mean of `window` pairs from it on less that of as
    /// many before it, its squares summed over luma and, weighted, the colour differences [grey levels²]. 0
    /// where a box does not fit into the row. window ≤ 32.
    void squared_steps(int window, float chroma_weight, std::vector<float>& steps);

  private:
    int pairs_ = 0;
    std::vector<std::int16_t> y_;  // sum of the two lumas
    std::vector<std::int16_t> cb_, cr_;
    std::vector<std::int16_t> sum_y_, sum_cb_, sum_cr_;  // over a box from each pair on
};

/// Mean of the pairs first … last in row y of a frame, as ChromaRow::mean() has it.
Appearance mean_of_pairs(YuyvView image, int y, int first, int last);

}  // namespace goalmouth
