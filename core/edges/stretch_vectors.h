#pragma once

#include "core/edges/appearance.h"
#include "core/edges/row_vectors.h"

#include <cstddef>
#include <cstdint>

// The loops over a stretch of a row, compiled for each kind of vector instructions. What RowStretch is made
// of.
namespace goalmouth {

/// unlike[i]: how unlike `surface` the mean of the pairs i … i + window − 1 looks, [grey levels], the root of
/// squared_unlikeness().
void box_unlikeness(Planes<const std::int16_t> planes, std::size_t count, std::size_t window,
                    const Appearance& surface, float chroma_weight, float* unlike);

/// Each of the first `pixels` of a row of pairs as a share of the way from a to b, 0 … 1, [1/65536], summed.
/// Whole vectors of pairs are read. a and b must differ.
std::int32_t sum_of_shares(const std::uint8_t* pairs, std::size_t pixels, const Appearance& a,
                           const Appearance& b);

}  // namespace goalmouth
