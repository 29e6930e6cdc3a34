#pragma once

#include <cstddef>

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

}  // namespace goalmouth
