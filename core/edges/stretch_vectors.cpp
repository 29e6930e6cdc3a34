#include "core/edges/stretch_vectors.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/edges/stretch_vectors.cpp"
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

// Products and sums are not fused, and shares are summed as whole numbers: alike on all machines.

HWY_INLINE F box_sum(const std::int16_t* values, std::size_t window) {
    const DH half;
    auto sum = hn::LoadU(half, values);
    for (std::size_t k = 1; k < window; ++k) sum = hn::Add(sum, hn::LoadU(half, values + k));
    return hn::ConvertTo(DF(), hn::PromoteTo(DI(), sum));
}

HWY_INLINE F dot(F ay, F acb, F acr, F by, F bcb, F bcr) {
    return hn::Add(hn::Add(hn::Mul(ay, by), hn::Mul(acb, bcb)), hn::Mul(acr, bcr));
}

HWY_INLINE F size_of(F y, F cb, F cr, F chroma_weight) {
    return hn::Add(hn::Mul(y, y), hn::Mul(chroma_weight, hn::Add(hn::Mul(cb, cb), hn::Mul(cr, cr))));
}

void BoxUnlikeness(Planes<const std::int16_t> planes, std::size_t count, std::size_t window,
                   const Appearance& surface, float chroma_weight, float* unlike) {
    const DF d;
    const F share = hn::Set(d, 1.F / static_cast<float>(window));
    const F y = hn::Set(d, surface.y);
    const F cb = hn::Set(d, surface.cb);
    const F cr = hn::Set(d, surface.cr);
    const F weight = hn::Set(d, chroma_weight);
    const F shade = hn::Set(d, shade_share);
    const float own = surface.dot(surface);
    const F per_own = hn::Set(d, own > 0.F ? 1.F / own : 0.F);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const F half_sum = hn::Mul(hn::Set(d, 0.5F), box_sum(planes.y + i, window));
        const F dy = hn::Sub(hn::Mul(half_sum, share), y);
        const F dcb = hn::Sub(hn::Mul(box_sum(planes.cb + i, window), share), cb);
        const F dcr = hn::Sub(hn::Mul(box_sum(planes.cr + i, window), share), cr);
        // As squared_unlikeness() does it.
        const F along = hn::Mul(dot(dy, dcb, dcr, y, cb, cr), per_own);
        const F ly = hn::Mul(y, along);
        const F lcb = hn::Mul(cb, along);
        const F lcr = hn::Mul(cr, along);
        const F off = size_of(hn::Sub(dy, ly), hn::Sub(dcb, lcb), hn::Sub(dcr, lcr), weight);
        const F lit = size_of(ly, lcb, lcr, weight);
        hn::StoreU(hn::Sqrt(hn::Add(off, hn::Mul(shade, lit))), d, unlike + i);
    }
}

HWY_INLINE F byte_at(I pairs, int shift) {
    return hn::ConvertTo(DF(), hn::And(hn::ShiftRightSame(pairs, shift), hn::Set(DI(), 0xFF)));
}

HWY_INLINE I share(F along) {
    const DF d;
    const F limited = hn::Min(hn::Max(along, hn::Zero(d)), hn::Set(d, 1.F));
    return hn::NearestInt(hn::Mul(limited, hn::Set(d, 65536.F)));
}

std::int32_t SumOfShares(const std::uint8_t* pairs, std::size_t pixels, const Appearance& a,
                         const Appearance& b) {
    const DI di;
    const DF d;
    const Appearance change = b - a;
    const Appearance step = change * (1.F / change.dot(change));
    // Of a pixel (Y, Cb, Cr): (Y, Cb − 128, Cr − 128)·step − a·step.
    const F from = hn::Set(d, a.dot(step) + 128.F * (step.cb + step.cr));
    const F y = hn::Set(d, step.y);
    I sum = hn::Zero(di);
    for (std::size_t i = 0; 2 * i < pixels; i += hn::Lanes(di)) {
        const I four = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(pairs + 4 * i));
        const F colour = hn::Sub(hn::Add(hn::Mul(byte_at(four, 8), hn::Set(d, step.cb)),
                                         hn::Mul(byte_at(four, 24), hn::Set(d, step.cr))),
                                 from);
        const I first = share(hn::Add(colour, hn::Mul(byte_at(four, 0), y)));
        const I second = share(hn::Add(colour, hn::Mul(byte_at(four, 16), y)));
        sum = hn::Add(sum, hn::IfThenElseZero(hn::FirstN(di, (pixels + 1) / 2 - i), first));
        sum = hn::Add(sum, hn::IfThenElseZero(hn::FirstN(di, pixels / 2 - i), second));
    }
    return hn::GetLane(hn::SumOfLanes(di, sum));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace goalmouth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(BoxUnlikeness);
HWY_EXPORT(SumOfShares);

void box_unlikeness(Planes<const std::int16_t> planes, std::size_t count, std::size_t window,
                    const Appearance& surface, float chroma_weight, float* unlike) {
    HWY_DYNAMIC_DISPATCH(BoxUnlikeness)(planes, count, window, surface, chroma_weight, unlike);
}
std::int32_t sum_of_shares(const std::uint8_t* pairs, std::size_t pixels, const Appearance& a,
                           const Appearance& b) {
    return HWY_DYNAMIC_DISPATCH(SumOfShares)(pairs, pixels, a, b);
}

}  // namespace goalmouth
#endif
