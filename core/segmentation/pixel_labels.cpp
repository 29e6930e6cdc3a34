#include "core/segmentation/pixel_labels.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/segmentation/pixel_labels.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Where a vector's entries can be gathered by one instruction, that takes about a quarter less time over the
// whole scan than storing the indices and looking them up one by one (measured on Sapphire Rapids, with
// AVX-512 as with AVX2). Elsewhere Highway's gather is such a loop itself, only through words instead of
// bytes.
constexpr bool table_gathers = HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2;

using D = hn::CappedTag<std::uint32_t, 16>;
using V = hn::Vec<D>;
constexpr std::size_t most_lanes = 16;

HWY_INLINE V load(const std::uint8_t* from) {
    return hn::LoadU(D(), reinterpret_cast<const std::uint32_t*>(from));
}

/// Index of a pair's chroma in a table of `bits`: where its luma profile starts.
template <int bits>
HWY_INLINE V profile(V pairs) {
    constexpr int shift = 8 - bits;
    const V mask = hn::Set(D(), (1U << bits) - 1U);
    const V cb = hn::And(hn::ShiftRight<8 + shift>(pairs), mask);
    const V cr = hn::ShiftRight<24 + shift>(pairs);
    return hn::Or(hn::ShiftLeft<2 * bits>(cb), hn::ShiftLeft<bits>(cr));
}

template <int bits>
HWY_INLINE V first_luma(V pairs) {
    return hn::And(hn::ShiftRight<8 - bits>(pairs), hn::Set(D(), (1U << bits) - 1U));
}

template <int bits>
HWY_INLINE V second_luma(V pairs) {
    return hn::And(hn::ShiftRight<24 - bits>(pairs), hn::Set(D(), (1U << bits) - 1U));
}

/// Four bytes of the table from each index on, of which the lowest is the label.
HWY_INLINE HWY_MAYBE_UNUSED V look_up(const std::uint8_t* table, V index) {
    const hn::RebindToSigned<D> di;
    return hn::GatherOffset(D(), reinterpret_cast<const std::uint32_t*>(table), hn::BitCast(di, index));
}

template <int bits>
HWY_INLINE void label_vector(const std::uint8_t* table, V pairs, std::uint8_t* labels) {
    const D d;
    const V start = profile<bits>(pairs);
    const V first = hn::Or(start, first_luma<bits>(pairs));
    const V second = hn::Or(start, second_luma<bits>(pairs));
    if constexpr (table_gathers) {
        const V a = hn::And(look_up(table, first), hn::Set(d, 0xFFU));
        const V b = hn::ShiftLeft<8>(look_up(table, second));
        const hn::Rebind<std::uint16_t, D> half;
        hn::StoreU(hn::TruncateTo(half, hn::Or(a, b)), half, reinterpret_cast<std::uint16_t*>(labels));
    } else {
        HWY_ALIGN std::uint32_t at[2][most_lanes];
        hn::Store(first, d, at[0]);
        hn::Store(second, d, at[1]);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
            labels[2 * i] = table[at[0][i]];
            labels[2 * i + 1] = table[at[1][i]];
        }
    }
}

template <int bits>
void label_row_of(const std::uint8_t* table, const std::uint8_t* row, std::size_t pairs,
                  std::uint8_t* labels) {
    const std::size_t lanes = hn::Lanes(D());
    std::size_t i = 0;
    for (; i + lanes <= pairs; i += lanes) label_vector<bits>(table, load(row + 4 * i), labels + 2 * i);
    if (i == pairs) return;
    HWY_ALIGN std::uint8_t rest[4 * most_lanes] = {};
    std::memcpy(rest, row + 4 * i, 4 * (pairs - i));
    label_vector<bits>(table, load(rest), labels + 2 * i);
}

/// Pixels are asked for so many rows before their turn: left to itself, the hardware fetches them too late.
constexpr int rows_ahead = 3;

/// Indices of the columns' pixels are held for so many at a time. Pixels and table are gathered in two loops
/// with the indices between: one after the other in one loop takes more than twice as long.
constexpr std::size_t index_count = 512;
static_assert(index_count % most_lanes == 0);

/// The table's indices of `count` columns' pixels in `row`, from column `first` on; asks for the same pixels
/// of the row `ahead`.
template <int bits>
HWY_INLINE void index_columns(const std::uint8_t* row, const std::uint8_t* ahead, const LabelColumns& columns,
                              std::size_t first, std::size_t count, std::uint32_t* index) {
    const D d;
    const hn::RebindToSigned<D> di;
    const std::int32_t* pair = columns.pair() + first;
    const std::int32_t* odd = columns.odd() + first;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        for (std::size_t k = i; k < i + hn::Lanes(d); k += columns.in_a_cache_line())
            hwy::Prefetch(ahead + pair[k]);
        const V pairs =
            hn::GatherOffset(d, reinterpret_cast<const std::uint32_t*>(row), hn::LoadU(di, pair + i));
        const auto second = hn::MaskFromVec(hn::BitCast(d, hn::LoadU(di, odd + i)));
        const V luma = hn::IfThenElse(second, second_luma<bits>(pairs), first_luma<bits>(pairs));
        hn::Store(hn::Or(profile<bits>(pairs), luma), d, index + i);
    }
}

HWY_INLINE void look_up_all(const std::uint8_t* table, const std::uint32_t* index, std::size_t count,
                            std::uint8_t* labels) {
    const D d;
    if constexpr (table_gathers) {
        const hn::Rebind<std::uint8_t, D> bytes;
        for (std::size_t i = 0; i < count; i += hn::Lanes(d))
            hn::StoreU(hn::TruncateTo(bytes, look_up(table, hn::Load(d, index + i))), bytes, labels + i);
    } else {
        for (std::size_t i = 0; i < count; ++i) labels[i] = table[index[i]];
    }
}

template <int bits>
void label_columns_of(const std::uint8_t* table, YuyvView image, int y, int rows, const LabelColumns& columns,
                      std::uint8_t* labels) {
    HWY_ALIGN std::uint32_t index[index_count];
    for (int end = y + rows; y < end; ++y) {
        const std::uint8_t* ahead = image.row(std::min(y + rows_ahead, image.height - 1));
        for (std::size_t first = 0; first < columns.size(); first += index_count) {
            const std::size_t count = std::min(index_count, columns.size() - first);
            index_columns<bits>(image.row(y), ahead, columns, first, count, index);
            look_up_all(table, index, count, labels);
            labels += count;
        }
    }
}

void LabelRow(const LabelTable& table, const std::uint8_t* row, std::size_t pairs, std::uint8_t* labels) {
    switch (table.bits()) {
        case 5:
            return label_row_of<5>(table.entries(), row, pairs, labels);
        case 6:
            return label_row_of<6>(table.entries(), row, pairs, labels);
        case 7:
            return label_row_of<7>(table.entries(), row, pairs, labels);
        default:
            return label_row_of<8>(table.entries(), row, pairs, labels);
    }
}

void LabelColumnsOfRows(const LabelTable& table, YuyvView image, int y, int rows, const LabelColumns& columns,
                        std::uint8_t* labels) {
    switch (table.bits()) {
        case 5:
            return label_columns_of<5>(table.entries(), image, y, rows, columns, labels);
        case 6:
            return label_columns_of<6>(table.entries(), image, y, rows, columns, labels);
        case 7:
            return label_columns_of<7>(table.entries(), image, y, rows, columns, labels);
        default:
            return label_columns_of<8>(table.entries(), image, y, rows, columns, labels);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace goalmouth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(LabelRow);
HWY_EXPORT(LabelColumnsOfRows);

LabelTable::LabelTable(const ColourTable& table)
    : bits_(table.bits()),
      entries_(hwy::AllocateAligned<std::uint8_t>(table.entries().size() + sizeof(std::uint32_t))) {
    if (!entries_) throw std::bad_alloc();
    std::copy(table.entries().begin(), table.entries().end(), entries_.get());
    std::fill_n(entries_.get() + table.entries().size(), sizeof(std::uint32_t), std::uint8_t{0});
}

void LabelColumns::assign(const std::vector<int>& columns) {
    size_ = columns.size();
    pair_.assign(size_ + label_margin, 0);
    odd_.assign(size_ + label_margin, 0);
    for (std::size_t i = 0; i < size_; ++i) {
        pair_[i] = 4 * (columns[i] / 2);
        odd_[i] = -(columns[i] % 2);
    }
    constexpr std::size_t cache_line = 64;  // bytes
    const auto span = size_ < 2 ? 0 : static_cast<std::size_t>(std::abs(columns.back() - columns.front()));
    in_a_cache_line_ = span == 0 ? 1 : std::clamp<std::size_t>(cache_line * (size_ - 1) / (2 * span), 1, 16);
}

void label_row(const LabelTable& table, const std::uint8_t* row, std::size_t pairs, std::uint8_t* labels) {
    HWY_DYNAMIC_DISPATCH(LabelRow)(table, row, pairs, labels);
}

void label_columns(const LabelTable& table, YuyvView image, int y, int rows, const LabelColumns& columns,
                   std::uint8_t* labels) {
    HWY_DYNAMIC_DISPATCH(LabelColumnsOfRows)(table, image, y, rows, columns, labels);
}

}  // namespace goalmouth
#endif
