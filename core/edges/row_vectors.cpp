#include "core/edges/row_vectors.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/edges/row_vectors.cpp"
#include <hwy/foreach_target.h>
//
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

void SplitRow(const std::uint8_t* row, std::size_t pairs, Planes<std::int16_t> planes) {
    const DI d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= pairs; i += lanes)
        split(hn::LoadU(d, reinterpret_cast<const std::int32_t*>(row + 4 * i)), planes, i);
    // No byte behind the row may be read.
    for (; i < pairs; ++i) {
        planes.y[i] = static_cast<std::int16_t>(row[4 * i] + row[4 * i + 2]);
        planes.cb[i] = static_cast<std::int16_t>(row[4 * i + 1] - 128);
        planes.cr[i] = static_cast<std::int16_t>(row[4 * i + 3] - 128);
    }
}

void BoxSums(const std::int16_t* values, std::size_t count, std::size_t window, std::int16_t* sums) {
    const hn::CappedTag<std::int16_t, 32> d;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        auto sum = hn::LoadU(d, values + i);
        for (std::size_t k = 1; k < window; ++k) sum = hn::Add(sum, hn::LoadU(d, values + i + k));
        hn::StoreU(sum, d, sums + i);
    }
}

HWY_INLINE F difference(const std::int16_t* sums, std::size_t window) {
    const DI d;
    const DH half;
    const I before = hn::PromoteTo(d, hn::LoadU(half, sums));
    const I after = hn::PromoteTo(d, hn::LoadU(half, sums + window));
    return hn::ConvertTo(DF(), hn::Sub(after, before));
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
        for (std::size_t k = 0; k < hn::Lanes(d); ++k)
            if ((bytes[k / 8] >> (k % 8) & 1) != 0 && i + k < count)
                *out++ = static_cast<std::int32_t>(i + k);
    }
    return static_cast<std::size_t>(out - peaks);
}

HWY_INLINE F two_pairs(const std::int16_t* values) {
    const DI d;
    const DH half;
    return hn::ConvertTo(DF(), hn::Add(hn::PromoteTo(d, hn::LoadU(half, values)),
                                       hn::PromoteTo(d, hn::LoadU(half, values + 1))));
}

void FindField(Planes<const std::int16_t> planes, std::size_t count, const FieldColour& field,
               std::uint8_t* is_field) {
    const DF d;
    const hn::Rebind<std::uint8_t, DF> bytes;
    const FieldColour::Ellipse e = field.ellipse();
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const F y = hn::Mul(two_pairs(planes.y + i), hn::Set(d, 0.25F));
        const F cb = hn::Mul(two_pairs(planes.cb + i), hn::Set(d, 0.5F));
        const F cr = hn::Mul(two_pairs(planes.cr + i), hn::Set(d, 0.5F));
        // As FieldColour::contains() does it.
        const F luma = hn::Add(y, hn::Set(d, chromaticity_dark));
        const F p = hn::Sub(cb, hn::Mul(hn::Set(d, e.u), luma));
        const F q = hn::Sub(cr, hn::Mul(hn::Set(d, e.v), luma));
        const F apart =
            hn::Add(hn::Add(hn::Mul(hn::Set(d, e.a), hn::Mul(p, p)), hn::Mul(hn::Set(d, e.b), hn::Mul(p, q))),
                    hn::Mul(hn::Set(d, e.c), hn::Mul(q, q)));
        auto in = hn::Lt(apart, hn::Mul(luma, luma));
        in = hn::And(in, hn::And(hn::Ge(y, hn::Set(d, e.darkest)), hn::Le(y, hn::Set(d, e.brightest))));
        const auto one = hn::IfThenElseZero(hn::RebindMask(DI(), in), hn::Set(DI(), 1));
        hn::StoreU(hn::DemoteTo(bytes, one), bytes, is_field + i);
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

void split_row(const std::uint8_t* row, std::size_t pairs, Planes<std::int16_t> planes) {
    HWY_DYNAMIC_DISPATCH(SplitRow)(row, pairs, planes);
}
void box_sums(const std::int16_t* values, std::size_t count, std::size_t window, std::int16_t* sums) {
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
void find_field(Planes<const std::int16_t> planes, std::size_t count, const FieldColour& field,
                std::uint8_t* is_field) {
    HWY_DYNAMIC_DISPATCH(FindField)(planes, count, field, is_field);
}

}  // namespace goalmouth
#endif
