#include "core/edges/chroma_row.h"

#include "core/edges/frame_scale.h"
#include "core/edges/row_vectors.h"

#include <algorithm>
#include <cassert>

namespace goalmouth {
namespace {

constexpr auto widest = static_cast<std::size_t>(widest_window);

/// Luma's and the colour differences' sums over the pairs first … last, which are in the row.
struct PairSums {
    PairSums(const std::uint8_t* row, int first, int last) {
        for (int i = first; i <= last; ++i) {
            luma += row[4 * i] + row[4 * i + 2];
            cb += row[4 * i + 1] - 128;
            cr += row[4 * i + 3] - 128;
        }
    }
    int luma = 0, cb = 0, cr = 0;
};

template <class T>
void make_room(std::vector<T>& array, std::size_t count) {
    if (array.size() < count) array.resize(count);
}

}  // namespace

void ChromaRow::load(YuyvView image, int y, int ahead) {
    pairs_ = (image.width + 1) / 2;
    for (auto* array : {&y_, &cb_, &cr_, &sum_y_, &sum_cb_, &sum_cr_})
        make_room(*array, size() + widest + row_margin);
    split_row(image.row(y), size(), {y_.data(), cb_.data(), cr_.data()}, image.row(ahead));
}

Appearance ChromaRow::mean(int first, int last) const {
    return mean_of({y_.data(), cb_.data(), cr_.data()}, std::max(first, 0), std::min(last, pairs_ - 1));
}

std::span<const float> ChromaRow::squared_steps(int window, float chroma_weight) {
    const auto w = static_cast<std::size_t>(window);
    assert(window >= 1 && w <= widest);
    steps_.assign(widest + size() + widest + row_margin, 0.F);
    const std::span<const float> steps(steps_.data() + widest, size());
    if (size() < 2 * w) return steps;
    box_sums(y_.data(), size() + 1 - w, w, sum_y_.data());
    box_sums(cb_.data(), size() + 1 - w, w, sum_cb_.data());
    box_sums(cr_.data(), size() + 1 - w, w, sum_cr_.data());
    square_steps({sum_y_.data(), sum_cb_.data(), sum_cr_.data()}, size() + 1 - 2 * w, w, chroma_weight,
                 steps_.data() + widest + w);
    // What whole vectors have written too much:
    std::fill(steps_.begin() + static_cast<std::ptrdiff_t>(widest + size() + 1 - w), steps_.end(), 0.F);
    return steps;
}

std::span<const std::int32_t> ChromaRow::peaks(float least, int reach) {
    assert(static_cast<std::size_t>(reach) <= widest);
    make_room(peaks_, size() + row_margin);
    const std::size_t count =
        find_peaks(steps_.data() + widest, size(), least, static_cast<std::size_t>(reach), peaks_.data());
    return {peaks_.data(), count};
}

Appearance mean_of_pairs(YuyvView image, int y, int first, int last) {
    first = std::max(first, 0);
    last = std::min(last, (image.width + 1) / 2 - 1);
    if (first > last) return {};
    const PairSums sums(image.row(y), first, last);
    const float share = 1.F / static_cast<float>(last - first + 1);
    return Appearance{0.5F * static_cast<float>(sums.luma), static_cast<float>(sums.cb),
                      static_cast<float>(sums.cr)} *
           share;
}

float squared_step(YuyvView image, int y, int pair, int window, float chroma_weight) {
    if (pair < window || pair + window > (image.width + 1) / 2) return 0.F;
    const PairSums before(image.row(y), pair - window, pair - 1);
    const PairSums after(image.row(y), pair, pair + window - 1);
    const auto pairs = static_cast<float>(window);
    const auto dy = static_cast<float>(after.luma - before.luma);
    const auto dcb = static_cast<float>(after.cb - before.cb);
    const auto dcr = static_cast<float>(after.cr - before.cr);
    return 0.25F / (pairs * pairs) * (dy * dy + 4.F * chroma_weight * (dcb * dcb + dcr * dcr));
}

}  // namespace goalmouth
