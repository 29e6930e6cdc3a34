#pragma once

#include "core/edges/appearance.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace goalmouth {

/// A row of a 4:2:2 frame in the resolution of its colour: one sample for each pair of pixels. Keeps its
/// memory from row to row. Vector instructions are those of the machine it runs on; the results are the same
/// on each, bit by bit.
class ChromaRow {
  public:
    /// Reads row y. Asks for the row `ahead` of the picture meanwhile: rows of a layout lie too far apart for
    /// the hardware to fetch the next one by itself.
    void load(YuyvView image, int y, int ahead);
    void load(YuyvView image, int y) { load(image, y, y); }

    int pairs() const { return pairs_; }
    Appearance at(int pair) const {
        const auto i = static_cast<std::size_t>(pair);
        return {0.5F * static_cast<float>(y_[i]), static_cast<float>(cb_[i]), static_cast<float>(cr_[i])};
    }
    /// Mean of the pairs first … last, which asks the frame; what of them lies beyond the row is left out.
    /// Nothing left: zero.
    Appearance mean(int first, int last) const;

    /// The row's derivative by two boxes: for each pair the mean of `window` pairs from it on less that of as
    /// many before it, its squares summed over luma and, weighted, the colour differences [grey levels²]. 0
    /// where a box does not fit into the row. window ≤ widest_window. Valid until the next call.
    std::span<const float> squared_steps(int window, float chroma_weight);

    /// Pairs at which the latest squared_steps() reach `least` and have no larger one, nor to the right an
    /// equal one, within `reach` ≤ widest_window pairs; ascending. Valid until the next call.
    std::span<const std::int32_t> peaks(float least, int reach);

  private:
    std::size_t size() const { return static_cast<std::size_t>(pairs_); }

    const std::uint8_t* row_ = nullptr;
    int pairs_ = 0;
    // Each with a margin behind it, since whole vectors are read and written:
    std::vector<std::int16_t> y_;                        // sum of the two lumas
    std::vector<std::int16_t> cb_, cr_;                  // about neutral
    std::vector<std::int16_t> sum_y_, sum_cb_, sum_cr_;  // over a box from each pair on
    std::vector<float> steps_;                           // behind as many zeros as `reach` may be
    std::vector<std::int32_t> peaks_;
};

}  // namespace goalmouth
