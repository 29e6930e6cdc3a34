#pragma once

#include "core/edges/appearance.h"

#include <cstddef>
#include <cstdint>

namespace goalmouth {

/// Luma and colour differences of a row's pairs, an array each.
template <class T>
struct Planes {
    T* y;
    T* cb;
    T* cr;
};

/// Entries that must follow the last one in every array: whole vectors are read and written.
inline constexpr std::size_t row_margin = 64;

/// Mean of the pairs first … last, of which `planes` hold the lumas' sums and the colour differences about
/// neutral; zero where last < first.
inline Appearance mean_of(Planes<const std::int16_t> planes, int first, int last) {
    if (first > last) return {};
    int luma = 0;
    int cb = 0;
    int cr = 0;
    for (int i = first; i <= last; ++i) {
        luma += planes.y[i];
        cb += planes.cb[i];
        cr += planes.cr[i];
    }
    const float share = 1.F / static_cast<float>(last - first + 1);
    return Appearance{0.5F * static_cast<float>(luma), static_cast<float>(cb), static_cast<float>(cr)} *
           share;
}

}  // namespace goalmouth
