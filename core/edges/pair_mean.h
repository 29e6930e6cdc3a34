#pragma once

#include "core/edges/appearance.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace goalmouth {

/// Mean of the pairs first … last of a row of 4:2:2 pixels, which are in it; zero where last < first. Two
/// pairs at a time, each sum a part of a word.
inline Appearance mean_of_pairs(const std::uint8_t* row, int first, int last) {
    if (first > last) return {};
    constexpr std::uint64_t every_other_byte = 0x00FF00FF00FF00FFULL;
    constexpr int at_once = 256;  // pairs whose sums of two have room in 16 bits
    const auto part = [](std::uint64_t word, int k) { return static_cast<int>(word >> (16 * k) & 0xFFFFU); };
    int luma = 0;
    int cb = 0;
    int cr = 0;
    for (int i = first; i <= last;) {
        const int end = std::min(last + 1, i + at_once);
        std::uint64_t lumas = 0;    // Y0, Y1 of even pairs, Y0, Y1 of odd ones
        std::uint64_t colours = 0;  // Cb, Cr likewise
        const auto add = [&](std::uint64_t pair_or_two) {
            lumas += pair_or_two & every_other_byte;
            colours += pair_or_two >> 8 & every_other_byte;
        };
        for (; i + 2 <= end; i += 2) {
            std::uint64_t two = 0;
            std::memcpy(&two, row + 4 * i, sizeof two);
            add(two);
        }
        if (i < end) {
            std::uint32_t one = 0;
            std::memcpy(&one, row + 4 * i, sizeof one);
            add(one);
            ++i;
        }
        luma += part(lumas, 0) + part(lumas, 1) + part(lumas, 2) + part(lumas, 3);
        cb += part(colours, 0) + part(colours, 2);
        cr += part(colours, 1) + part(colours, 3);
    }
    const int pairs = last - first + 1;
    const float share = 1.F / static_cast<float>(pairs);
    return Appearance{0.5F * static_cast<float>(luma), static_cast<float>(cb - 128 * pairs),
                      static_cast<float>(cr - 128 * pairs)} *
           share;
}

}  // namespace goalmouth
