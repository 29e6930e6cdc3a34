#pragma once

#include "core/edges/field_colour.h"

#include <cstddef>
#include <cstdint>

// The loops over a row's pairs, compiled for each kind of vector instructions. What ChromaRow is made of.
namespace goalmouth {

/// Entries that must follow the last one in every array below: whole vectors are read and written.
inline constexpr std::size_t row_margin = 64;

/// Luma and colour differences, an array each.
template <class T>
struct Planes {
    T* y;
    T* cb;
    T* cr;
};

/// Sums of a pair's lumas; its colour differences about neutral.
void split_row(const std::uint8_t* row, std::size_t pairs, Planes<std::int16_t> planes);

/// sums[i] = values[i] + … + values[i + window − 1]; no sum may exceed 16 bits.
void box_sums(const std::int16_t* values, std::size_t count, std::size_t window, std::int16_t* sums);

/// Squared size of (sums[i + window] − sums[i]), in grey levels² of a pair: weighted as ChromaRow says.
void square_steps(Planes<const std::int16_t> sums, std::size_t count, std::size_t window, float chroma_weight,
                  float* steps);

/// As ChromaRow::peaks(); `reach` values before the first one are read as well. Returns how many.
std::size_t find_peaks(const float* steps, std::size_t count, float least, std::size_t reach,
                       std::int32_t* peaks);

/// 1 where the mean of a pair and the next one is the field's, else 0.
void find_field(Planes<const std::int16_t> planes, std::size_t count, const FieldColour& field,
                std::uint8_t* is_field);

}  // namespace goalmouth
