#include "core/edges/chroma_row.h"

#include <algorithm>

namespace goalmouth {

void ChromaRow::load(YuyvView image, int y) {
    pairs_ = (image.width + 1) / 2;
    const auto n = static_cast<std::size_t>(pairs_);
    if (y_.size() < n) {
        y_.resize(n);
        cb_.resize(n);
        cr_.resize(n);
    }
    const std::uint8_t* row = image.row(y);
    for (std::size_t i = 0; i < n; ++i) {
        y_[i] = static_cast<std::int16_t>(row[4 * i] + row[4 * i + 2]);
        cb_[i] = row[4 * i + 1];
        cr_[i] = row[4 * i + 3];
    }
}

Appearance ChromaRow::mean(int first, int last) const {
    first = std::max(first, 0);
    last = std::min(last, pairs_ - 1);
    Appearance sum;
    for (int i = first; i <= last; ++i) sum = sum + at(i);
    return first <= last ? sum * (1.F / static_cast<float>(last - first + 1)) : sum;
}

void ChromaRow::squared_steps(int window, float chroma_weight, std::vector<float>& steps) {
    const auto n = static_cast<std::size_t>(pairs_);
    const auto w = static_cast<std::size_t>(window);
    steps.assign(n, 0.F);
    if (n < 2 * w) return;
    if (sum_y_.size() < n) {
        sum_y_.resize(n);
        sum_cb_.resize(n);
        sum_cr_.resize(n);
    }
    for (std::size_t i = 0; i + w <= n; ++i) {
        int sy = 0, sb = 0, sr = 0;
        for (std::size_t k = 0; k < w; ++k) {
            sy += y_[i + k];
            sb += cb_[i + k];
            sr += cr_[i + k];
        }
        sum_y_[i] = static_cast<std::int16_t>(sy);
        sum_cb_[i] = static_cast<std::int16_t>(sb);
        sum_cr_[i] = static_cast<std::int16_t>(sr);
    }
    const float scale = 0.25F / static_cast<float>(window * window);
    const float weight = 4.F * chroma_weight;
    for (std::size_t i = w; i + w <= n; ++i) {
        const auto dy = static_cast<float>(sum_y_[i] - sum_y_[i - w]);
        const auto db = static_cast<float>(sum_cb_[i] - sum_cb_[i - w]);
        const auto dr = static_cast<float>(sum_cr_[i] - sum_cr_[i - w]);
        steps[i] = scale * (dy * dy + weight * (db * db + dr * dr));
    }
}

Appearance mean_of_pairs(YuyvView image, int y, int first, int last) {
    first = std::max(first, 0);
    last = std::min(last, (image.width + 1) / 2 - 1);
    if (first > last) return {};
    const std::uint8_t* row = image.row(y);
    int luma = 0, cb = 0, cr = 0;
    for (int i = first; i <= last; ++i) {
        luma += row[4 * i] + row[4 * i + 2];
        cb += row[4 * i + 1] - 128;
        cr += row[4 * i + 3] - 128;
    }
    const float share = 1.F / static_cast<float>(last - first + 1);
    return Appearance{0.5F * static_cast<float>(luma), static_cast<float>(cb), static_cast<float>(cr)} *
           share;
}

}  // namespace goalmouth
