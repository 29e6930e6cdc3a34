#include "core/edges/row_stretch.h"

#include "core/edges/pair_mean.h"
#include "core/edges/row_vectors.h"
#include "core/edges/stretch_vectors.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <hwy/cache_control.h>

namespace goalmouth {
namespace {

/// Whole vectors of pairs, so that none is split one by one.
std::size_t rounded_up(std::size_t pairs) {
    return (pairs + 15) / 16 * 16;
}

}  // namespace

void RowStretch::load(YuyvView image, int y, int first, int end) {
    width_ = image.width;
    first_ = std::max(first, 0);
    end_ = std::max(first_, std::min(end, (image.width + 1) / 2));
    const auto pairs = static_cast<std::size_t>(end_ - first_);
    if (y_.size() < pairs + row_margin) {
        for (auto* array : {&y_, &cb_, &cr_}) array->resize(pairs + row_margin);
        bytes_.resize(4 * (pairs + row_margin));
    }
    if (pairs == 0) return;
    std::memcpy(bytes_.data(), image.row(y) + 4 * first_, 4 * pairs);
    split_row(bytes_.data(), rounded_up(pairs), {y_.data(), cb_.data(), cr_.data()}, bytes_.data());
}

void RowStretch::ask_for(YuyvView image, int y) const {
    constexpr int pairs_of_a_cache_line = 16;
    for (int pair = first_; pair < end_; pair += pairs_of_a_cache_line)
        hwy::Prefetch(image.row(y) + 4 * pair);
    if (first_ < end_) hwy::Prefetch(image.row(y) + 4 * (end_ - 1));
}

Appearance RowStretch::mean(int first, int last) const {
    return mean_of_pairs(bytes_.data(), std::max(first, first_) - first_, std::min(last, end_ - 1) - first_);
}

std::span<const float> RowStretch::unlikeness(int first, int last, int window, const Appearance& surface,
                                              float chroma_weight) {
    assert(first >= first_ && last + window <= end_ && last >= first);
    const auto from = static_cast<std::size_t>(first - first_);
    const auto count = static_cast<std::size_t>(last - first) + 1;
    if (unlike_.size() < count + row_margin) unlike_.resize(count + row_margin);
    box_unlikeness({y_.data() + from, cb_.data() + from, cr_.data() + from}, count,
                   static_cast<std::size_t>(window), surface, chroma_weight, unlike_.data());
    return {unlike_.data(), count};
}

double RowStretch::step_place(int pair, int reach, const Appearance& a, const Appearance& b) const {
    const int first = std::max(first_, pair - reach);
    const int end = std::min({2 * end_, 2 * (pair + reach), width_});  // px
    const int pixels = end - 2 * first;
    const std::int32_t b_sum =
        sum_of_shares(bytes_.data() + 4 * (first - first_), static_cast<std::size_t>(pixels), a, b);
    return end - 0.5 - b_sum / 65536.0;
}

}  // namespace goalmouth
