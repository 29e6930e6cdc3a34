#include "core/edges/chroma_row.h"

#include "core/edges/frame_scale.h"
#include "core/edges/pair_mean.h"
#include "core/edges/row_vectors.h"

#include <algorithm>
#include <cassert>

namespace goalmouth {
namespace {

constexpr auto widest = static_cast<std::size_t>(widest_window);

template <class T>
void make_room(std::vector<T>& array, std::size_t count) {
    if (array.size() < count) array.resize(count);
}

}  // namespace

void ChromaRow::load(YuyvView image, int y, int ahead) {
    row_ = image.row(y);
    pairs_ = (image.width + 1) / 2;
    for (auto* array : {&y_, &cb_, &cr_, &sum_y_, &sum_cb_, &sum_cr_})
        make_room(*array, size() + widest + row_margin);
    split_row(row_, size(), {y_.data(), cb_.data(), cr_.data()}, image.row(ahead));
}

Appearance ChromaRow::mean(int first, int last) const {
    return mean_of_pairs(row_, std::max(first, 0), std::min(last, pairs_ - 1));
}

std::span<const float> ChromaRow::squared_steps(int window, float chroma_weight) {
    const auto w = static_cast<std::size_t>(window);
    assert(window >= 1 && w <= widest);
    make_room(steps_, widest + size() + widest + row_margin);
    const std::span<const float> steps(steps_.data() + widest, size());
    const auto without = [&](std::size_t from, std::size_t to) {
        std::fill(steps_.begin() + static_cast<std::ptrdiff_t>(widest + from),
                  steps_.begin() + static_cast<std::ptrdiff_t>(widest + to), 0.F);
    };
    if (size() < 2 * w) {
        without(0, size() + widest + row_margin);
        return steps;
    }
    without(0, w);
    box_sums({y_.data(), cb_.data(), cr_.data()}, size() + 1 - w, w,
             {sum_y_.data(), sum_cb_.data(), sum_cr_.data()});
    square_steps({sum_y_.data(), sum_cb_.data(), sum_cr_.data()}, size() + 1 - 2 * w, w, chroma_weight,
                 steps_.data() + widest + w);
    // What whole vectors have written too much:
    without(size() + 1 - w, size() + widest + row_margin);
    return steps;
}

std::span<const std::int32_t> ChromaRow::peaks(float least, int reach) {
    assert(static_cast<std::size_t>(reach) <= widest);
    make_room(peaks_, size() + row_margin);
    const std::size_t count =
        find_peaks(steps_.data() + widest, size(), least, static_cast<std::size_t>(reach), peaks_.data());
    return {peaks_.data(), count};
}

}  // namespace goalmouth
