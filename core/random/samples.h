#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace goalmouth {

/// Number `place` of the sequence that `key` begins, without those before it: SplitMix64 (Steele, Lea and
/// Flood, 2014), whose state only counts.
inline std::uint64_t keyed_bits(std::uint64_t key, std::uint64_t place) {
    std::uint64_t z = key + (place + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
}

/// The sample `place` of those that `key` stands for: different numbers of 0 … count−1, count ≥ size.
///
/// Any sample is a function of these alone, so that many can be drawn at once and in any order. Each of its
/// numbers is one of those left, all with the same probability to within 2^-32: half of a 64-bit number times
/// how many are left, of which the upper half is taken.
template <std::size_t size>
std::array<std::uint32_t, size> draw_sample(std::uint64_t key, std::uint64_t place, std::uint32_t count) {
    constexpr std::uint64_t words = (size + 1) / 2;
    std::array<std::uint32_t, size> drawn;
    std::array<std::uint32_t, size> ascending;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
        bits = i % 2 == 0 ? keyed_bits(key, place * words + i / 2) : bits << 32;
        const std::uint64_t left = count - i;
        auto index = static_cast<std::uint32_t>(((bits >> 32) * left) >> 32);
        std::size_t below = 0;
        for (; below < i && index >= ascending[below]; ++below) ++index;
        for (std::size_t j = i; j > below; --j) ascending[j] = ascending[j - 1];
        ascending[below] = index;
        drawn[i] = index;
    }
    return drawn;
}

/// draw_sample<2>() for `pairs` places from `place` on, each as its first number + 2^32 · its second; room
/// for 8 more in `drawn`.
void draw_pairs(std::uint64_t key, std::uint64_t place, std::uint32_t count, std::size_t pairs,
                std::uint64_t* drawn);

}  // namespace goalmouth
