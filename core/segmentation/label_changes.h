#pragma once

#include <cstddef>
#include <cstdint>

namespace goalmouth {

/// Where two runs of labels differ: ascending positions 0 ≤ i < count with a[i] ≠ b[i]. Returns how many;
/// `positions` has room for `count`. So many bytes as label_margin behind either run must be readable.
std::size_t find_changes(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                         std::int32_t* positions);

}  // namespace goalmouth
