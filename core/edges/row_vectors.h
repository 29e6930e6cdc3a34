#pragma once

#include "core/edges/field_colour.h"
#include "core/edges/planes.h"

#include <cstddef>
#include <cstdint>

// The loops over a row's pairs, compiled for each kind of vector instructions. What ChromaRow is made of.
// Arrays have row_margin entries behind the last one.
namespace goalmouth {

/// Sums of a pair's lumas; its colour differences about neutral. Asks for the memory at `ahead` meanwhile, as
/// much of it.
void split_row(const std::uint8_t* row, std::size_t pairs, Planes<std::int16_t> planes,
               const std::uint8_t* ahead);

/// In each plane sums[i] = values[i] + … + values[i + window − 1]; no sum may exceed 16 bits.
void box_sums(Planes<const std::int16_t> values, std::size_t count, std::size_t window,
              Planes<std::int16_t> sums);

/// Squared size of (sums[i + window] − sums[i]), in grey levels² of a pair: weighted as ChromaRow says.
void square_steps(Planes<const std::int16_t> sums, std::size_t count, std::size_t window, float chroma_weight,
                  float* steps);

/// As ChromaRow::peaks(); `reach` values before the first one are read as well. Returns how many.
std::size_t find_peaks(const float* steps, std::size_t count, float least, std::size_t reach,
                       std::int32_t* peaks);

/// 1 where the mean of the row's pairs pairs[i] and pairs[i] + 1 is the field's, else 0.
void find_field(const std::uint8_t* row, const std::int32_t* pairs, std::size_t count,
                const FieldColour& field, std::uint8_t* is_field);

/// Of a mask, row by row, the row of each column from which on down it holds the most ones, each zero
/// counting half against them; `rows` where that is none. Ones above it become zeros.
void find_ground(std::uint8_t* is_field, std::size_t rows, std::size_t columns, std::int32_t* begins);

}  // namespace goalmouth
