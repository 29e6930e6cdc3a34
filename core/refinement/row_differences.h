#pragma once

#include "core/refinement/post_colour.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace goalmouth {

/// Pairs of pixels next to one another, and how far the colour of each is from a post's.
struct RowDifferences {
    static constexpr std::size_t most = 128, room = 16;
    alignas(64) std::array<float, most + room> difference{};  // PostColour::difference
};

/// Of the mean of two rows, bytes Y0 Cb Y1 Cr from `upper` and `lower` on, read as levels: of `pairs` of
/// them, RowDifferences::most at most. Nothing is read beyond these.
void row_differences(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pairs,
                     const PostColour& colour, RowDifferences& differences);

}  // namespace goalmouth
