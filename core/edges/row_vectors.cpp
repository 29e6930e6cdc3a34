#include "core/edges/row_vectors.h"

#include <cstring>

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/edges/row_vectors.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using DI = hn::CappedTag<std::int32_t, 16>;
using DF = hn::RebindToFloat<DI>;
using DH = hn::Rebind<std::int16_t, DI>;  // half as long as a vector
using I = hn::Vec<DI>;
using F = hn::Vec<DF>;

// Squares of sums over at most 32 pairs stay below 2²⁴·16, sums of two of them are rounded once and alike on
// all machines: products and sums are not fused.

constexpr std::size_t pairs_of_a_cache_line = 16;

HWY_INLINE I low_byte(I v) {
    return hn::And(v, hn::Set(DI(), 0xFF));
}

HWY_INLINE void split(I pairs, Planes<std::int16_t> planes, std::size_t i) {
    const DI d;
    const DH half;
    const I neutral = hn::Set(d, 128);
    const I y = hn::Add(low_byte(pairs), low_byte(hn::ShiftRight<16>(pairs)));
    const I cb = hn::Sub(low_byte(hn::ShiftRight<8>(pairs)), neutral);
    const I cr = hn::Sub(low_byte(hn::ShiftRight<24>(pairs)), neutral);
    hn::StoreU(hn::DemoteTo(half, y), half, planes.y + i);
    hn::StoreU(hn::DemoteTo(half, cb), half, planes.cb + i);
    hn::StoreU(hn::DemoteTo(half, cr), half, planes.cr + i);
}

void SplitRow(const std::uint8_t* row, std::size_t pairs, Planes<std::int16_t> planes,
              const std::uint8_t* ahead) {
    const DI d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= pairs; i += lanes) {
        if (i % pairs_of_a_cache_line == 0) hwy::Prefetch(ahead + 4 * i);
        split(hn::LoadU(d, reinterpret_cast<const std::int32_t*>(row + 4 * i)), planes, i);
    }
    // No byte behind the row may be read.
    for (; i < pairs; ++i) {
        planes.y[i] = static_cast<std::int16_t>(row[4 * i] + row[4 * i + 2]);
        planes.cb[i] = static_cast<std::int16_t>(row[4 * i + 1] - 128);
        planes.cr[i] = static_cast<std::int16_t>(row[4 * i + 3] - 128);
    }
}

void BoxSums(Planes<const std::int16_t> values, std::size_t count, std::size_t window,
             Planes<std::int16_t> sums) {
    // Longer vectors would lie across two cache lines each time.
    const hn::CappedTag<std::int16_t, 16> d;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        auto y = hn::LoadU(d, values.y + i);
        auto cb = hn::LoadU(d, values.cb + i);
        auto cr = hn::LoadU(d, values.cr + i);
        for (std::size_t k = i + 1; k < i + window; ++k) {
            y = hn::Add(y, hn::LoadU(d, values.y + k));
            cb = hn::Add(cb, hn::LoadU(d, values.cb + k));
            cr = hn::Add(cr, hn::LoadU(d, values.cr + k));
        }
        hn::StoreU(y, d, sums.y + i);
        hn::StoreU(cb, d, sums.cb + i);
        hn::StoreU(cr, d, sums.cr + i);
    }
}

HWY_INLINE F difference(const std::int16_t* sums, std::size_t window) {
    const DI d;
    const DH half;
    const auto change = hn::Sub(hn::LoadU(half, sums + window), hn::LoadU(half, sums));
    return hn::ConvertTo(DF(), hn::PromoteTo(d, change));
}

void SquareSteps(Planes<const std::int16_t> sums, std::size_t count, std::size_t window, float chroma_weight,
                 float* steps) {
    const DF d;
    const auto pairs = static_cast<float>(window);
    const F scale = hn::Set(d, 0.25F / (pairs * pairs));
    const F weight = hn::Set(d, 4.F * chroma_weight);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const F y = difference(sums.y + i, window);
        const F cb = difference(sums.cb + i, window);
        const F cr = difference(sums.cr + i, window);
        const F chroma = hn::Add(hn::Mul(cb, cb), hn::Mul(cr, cr));
        const F sum = hn::Add(hn::Mul(y, y), hn::Mul(weight, chroma));
        hn::StoreU(hn::Mul(scale, sum), d, steps + i);
    }
}

std::size_t FindPeaks(const float* steps, std::size_t count, float least, std::size_t reach,
                      std::int32_t* peaks) {
    const DF d;
    const F bound = hn::Set(d, least);
    std::int32_t* out = peaks;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const F here = hn::LoadU(d, steps + i);
        auto peak = hn::Ge(here, bound);
        if (HWY_LIKELY(hn::AllFalse(d, peak))) continue;
        for (std::size_t k = 1; k <= reach; ++k) {
            peak = hn::And(peak, hn::And(hn::Ge(here, hn::LoadU(d, steps + i - k)),
                                         hn::Gt(here, hn::LoadU(d, steps + i + k))));
        }
        HWY_ALIGN std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, peak, bytes);
        std::uint32_t bits = static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
        if (count - i < 16) bits &= (1U << (count - i)) - 1U;
        for (; bits != 0; bits &= bits - 1)
            *out++ = static_cast<std::int32_t>(i + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
    }
    return static_cast<std::size_t>(out - peaks);
}

/// Columns whose pixels are put side by side before they are worked on.
constexpr std::size_t side_by_side = 64;

void FindField(const std::uint8_t* row, const std::int32_t* pairs, std::size_t count,
               const FieldColour& field, std::uint8_t* is_field) {
    const DI di;
    const DF d;
    const hn::Rebind<std::uint8_t, DF> bytes;
    const FieldColour::Ellipse e = field.ellipse();
    HWY_ALIGN std::int32_t two[2 * side_by_side] = {};
    for (std::size_t from = 0; from < count; from += side_by_side) {
        const std::size_t columns = HWY_MIN(side_by_side, count - from);
        for (std::size_t k = 0; k < columns; ++k) std::memcpy(two + 2 * k, row + 4 * pairs[from + k], 8);
        for (std::size_t i = 0; i < columns; i += hn::Lanes(di)) {
            I a, b;
            hn::LoadInterleaved2(di, two + 2 * i, a, b);
            const auto sum = [&](int shift) {
                return hn::Add(low_byte(hn::ShiftRightSame(a, shift)),
                               low_byte(hn::ShiftRightSame(b, shift)));
            };
            const I neutral = hn::Set(di, 256);
            const F y = hn::Mul(hn::ConvertTo(d, hn::Add(sum(0), sum(16))), hn::Set(d, 0.25F));
            const F cb = hn::Mul(hn::ConvertTo(d, hn::Sub(sum(8), neutral)), hn::Set(d, 0.5F));
            const F cr = hn::Mul(hn::ConvertTo(d, hn::Sub(sum(24), neutral)), hn::Set(d, 0.5F));
            // As FieldColour::contains() does it.
            const F luma = hn::Add(y, hn::Set(d, chromaticity_dark));
            const F p = hn::Sub(cb, hn::Mul(hn::Set(d, e.u), luma));
            const F q = hn::Sub(cr, hn::Mul(hn::Set(d, e.v), luma));
            const F apart = hn::Add(
                hn::Add(hn::Mul(hn::Set(d, e.a), hn::Mul(p, p)), hn::Mul(hn::Set(d, e.b), hn::Mul(p, q))),
                hn::Mul(hn::Set(d, e.c), hn::Mul(q, q)));
            auto in = hn::Lt(apart, hn::Mul(luma, luma));
            in = hn::And(in, hn::And(hn::Ge(y, hn::Set(d, e.darkest)), hn::Le(y, hn::Set(d, e.brightest))));
            const auto one = hn::IfThenElseZero(hn::RebindMask(di, in), hn::Set(di, 1));
            hn::StoreU(hn::DemoteTo(bytes, one), bytes, is_field + from + i);
        }
    }
}

void FindGround(std::uint8_t* is_field, std::size_t rows, std::size_t columns, std::int32_t* begins) {
    const DI d;
    const hn::Rebind<std::uint8_t, DI> bytes;
    for (std::size_t c = 0; c < columns; c += hn::Lanes(d)) {
        const auto row = [&](std::size_t r) { return is_field + r * columns + c; };
        I sum = hn::Zero(d);
        I most = hn::Zero(d);
        I best = hn::Set(d, static_cast<std::int32_t>(rows));
        for (std::size_t r = rows; r-- > 0;) {
            const I field = hn::PromoteTo(d, hn::LoadU(bytes, row(r)));
            // 2 for each that is field, −1 for each that is not.
            sum = hn::Add(sum, hn::Sub(hn::Add(field, hn::Add(field, field)), hn::Set(d, 1)));
            const auto more = hn::Gt(sum, most);
            most = hn::Max(most, sum);
            best = hn::IfThenElse(more, hn::Set(d, static_cast<std::int32_t>(r)), best);
        }
        hn::StoreU(best, d, begins + c);
        const auto here = hn::FirstN(d, columns - c);
        for (std::size_t r = 0; r < rows; ++r) {
            const auto above = hn::And(hn::Gt(best, hn::Set(d, static_cast<std::int32_t>(r))), here);
            if (hn::AllFalse(d, above)) break;
            const I field = hn::PromoteTo(d, hn::LoadU(bytes, row(r)));
            hn::StoreU(hn::DemoteTo(bytes, hn::IfThenZeroElse(above, field)), bytes, row(r));
        }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace goalmouth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(SplitRow);
HWY_EXPORT(BoxSums);
HWY_EXPORT(SquareSteps);
HWY_EXPORT(FindPeaks);
HWY_EXPORT(FindField);
HWY_EXPORT(FindGround);

void split_row(const std::uint8_t* row, std::size_t pairs, Planes<std::int16_t> planes,
               const std::uint8_t* ahead) {
    HWY_DYNAMIC_DISPATCH(SplitRow)(row, pairs, planes, ahead);
}
void box_sums(Planes<const std::int16_t> values, std::size_t count, std::size_t window,
              Planes<std::int16_t> sums) {
    HWY_DYNAMIC_DISPATCH(BoxSums)(values, count, window, sums);
}
void square_steps(Planes<const std::int16_t> sums, std::size_t count, std::size_t window, float chroma_weight,
                  float* steps) {
    HWY_DYNAMIC_DISPATCH(SquareSteps)(sums, count, window, chroma_weight, steps);
}
std::size_t find_peaks(const float* steps, std::size_t count, float least, std::size_t reach,
                       std::int32_t* peaks) {
    return HWY_DYNAMIC_DISPATCH(FindPeaks)(steps, count, least, reach, peaks);
}
void find_field(const std::uint8_t* row, const std::int32_t* pairs, std::size_t count,
                const FieldColour& field, std::uint8_t* is_field) {
    HWY_DYNAMIC_DISPATCH(FindField)(row, pairs, count, field, is_field);
}
void find_ground(std::uint8_t* is_field, std::size_t rows, std::size_t columns, std::int32_t* begins) {
    HWY_DYNAMIC_DISPATCH(FindGround)(is_field, rows, columns, begins);
}

}  // namespace goalmouth
#endif
