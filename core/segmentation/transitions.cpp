#include "core/segmentation/transitions.h"

#include "core/segmentation/transition.h"

#include <algorithm>
#include <cmath>

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/segmentation/transitions.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using DI = hn::CappedTag<std::int32_t, transition_margin>;
using DF = hn::RebindToFloat<DI>;
using I = hn::Vec<DI>;
using F = hn::Vec<DF>;
using M = hn::Mask<DF>;

// Sums of products of pixel values stay below 2²⁴, so floats hold them without rounding and no order of
// adding or fusing changes them.

struct Pixels {
    F y, cb, cr;
};

HWY_INLINE F to_float(I v) {
    return hn::ConvertTo(DF(), v);
}

HWY_INLINE I low_byte(I v) {
    return hn::And(v, hn::Set(DI(), 0xFF));
}

HWY_INLINE I gather(const std::uint8_t* base, I offset) {
    return hn::GatherOffset(DI(), reinterpret_cast<const std::int32_t*>(base), offset);
}

HWY_INLINE Pixels pixels(I pairs, hn::Mask<DI> second) {
    const I y = hn::IfThenElse(second, hn::ShiftRight<16>(pairs), pairs);
    return {to_float(low_byte(y)), to_float(low_byte(hn::ShiftRight<8>(pairs))),
            to_float(low_byte(hn::ShiftRight<24>(pairs)))};
}

/// How many pixels a window takes of a segment of `length` next to its change.
HWY_INLINE I reach(I length) {
    const DI d;
    const I full = hn::Set(d, 3);
    const I half = hn::Min(full, hn::ShiftRight<1>(hn::Add(length, hn::Set(d, 1))));
    return hn::IfThenElse(hn::Lt(length, hn::Set(d, 3)), full, half);
}

/// The sides a and b of the edges, and what the pixels between have of b.
class Edges {
  public:
    HWY_INLINE Edges(Pixels a, Pixels b)
        : a_(a),
          dy_(hn::Sub(b.y, a.y)),
          dcb_(hn::Sub(b.cb, a.cb)),
          dcr_(hn::Sub(b.cr, a.cr)),
          contrast_(hn::MulAdd(dy_, dy_, hn::MulAdd(dcb_, dcb_, hn::Mul(dcr_, dcr_)))),
          still_a_(hn::Zero(DF())) {}

    HWY_INLINE F chroma_share(F cb, F cr) const {
        return hn::MulAdd(dcb_, hn::Sub(cb, a_.cb), hn::Mul(dcr_, hn::Sub(cr, a_.cr)));
    }
    HWY_INLINE void add(F y, F chroma_share, M inside) {
        const F share = hn::MulAdd(dy_, hn::Sub(y, a_.y), chroma_share);
        const F clamped = hn::Min(hn::Max(share, hn::Zero(DF())), contrast_);
        still_a_ = hn::Add(still_a_, hn::IfThenElseZero(inside, hn::Sub(contrast_, clamped)));
    }
    /// Where the edges lie, limited and rounded, for windows that begin at `first`.
    HWY_INLINE F transition(I first, I boundary) const {
        const DF d;
        const F half = hn::Set(d, 0.5F);
        const F nominal = hn::Sub(to_float(boundary), half);
        const F edge = hn::Add(hn::Sub(to_float(first), half), hn::Div(still_a_, contrast_));
        const F limit = hn::Set(d, 1.27F);
        F offset = hn::Min(hn::Max(hn::Sub(edge, nominal), hn::Neg(limit)), limit);
        offset = hn::IfThenElseZero(hn::Gt(contrast_, hn::Zero(d)), offset);
        // Halves away from zero, without a sum that a compiler could fuse with the product.
        const F hundredths = hn::Mul(hn::Set(d, 100.0F), offset);
        const F size = hn::Abs(hundredths);
        const F below = to_float(hn::ConvertTo(DI(), size));
        const F up = hn::IfThenElseZero(hn::Ge(size, hn::Add(below, half)), hn::Set(d, 1.0F));
        const F rounded = hn::CopySign(hn::Add(below, up), hundredths);
        return hn::Add(nominal, hn::Div(rounded, hn::Set(d, 100.0F)));
    }

  private:
    Pixels a_;
    F dy_, dcb_, dcr_, contrast_;
    F still_a_;  // Σ (1 − share), in units of 1/contrast
};

void LocateInRow(const std::uint8_t* row, int width, std::size_t count, const std::int32_t* starts,
                 float* transitions) {
    const DI d;
    const I one = hn::Set(d, 1);
    const I end = hn::Set(d, width - 1);
    for (std::size_t i = 1; i < count; i += hn::Lanes(d)) {
        const I boundary = hn::LoadU(d, starts + i);
        const I before = reach(hn::Sub(boundary, hn::LoadU(d, starts + i - 1)));
        const I after = reach(hn::Sub(hn::LoadU(d, starts + i + 1), boundary));
        // Whole pairs: at most 6 pixels, widened to at most 4 pairs.
        I first = hn::Max(hn::Zero(d), hn::Sub(boundary, before));
        first = hn::AndNot(one, first);
        I last = hn::Min(end, hn::Sub(hn::Add(boundary, after), one));
        last = hn::Min(end, hn::Or(last, one));
        const auto valid = hn::FirstN(d, count - i);
        const I first_pair = hn::IfThenElseZero(valid, hn::ShiftLeft<1>(first));
        const I last_pair = hn::IfThenElseZero(valid, hn::ShiftLeft<1>(hn::AndNot(one, last)));
        I pairs[4];
        for (int k = 0; k < 4; ++k)
            pairs[k] = gather(row, hn::Min(last_pair, hn::Add(first_pair, hn::Set(d, 4 * k))));

        const I beyond = hn::Add(last, one);
        const auto last_is_second = hn::Eq(hn::And(last, one), one);
        Edges edges(pixels(pairs[0], hn::MaskFromVec(hn::Zero(d))), pixels(pairs[3], last_is_second));
        for (int k = 0; k < 4; ++k) {
            const F chroma = edges.chroma_share(to_float(low_byte(hn::ShiftRight<8>(pairs[k]))),
                                                to_float(low_byte(hn::ShiftRight<24>(pairs[k]))));
            const I x = hn::Add(first, hn::Set(d, 2 * k));
            edges.add(to_float(low_byte(pairs[k])), chroma, hn::RebindMask(DF(), hn::Lt(x, beyond)));
            edges.add(to_float(low_byte(hn::ShiftRight<16>(pairs[k]))), chroma,
                      hn::RebindMask(DF(), hn::Lt(x, last)));
        }
        hn::StoreU(edges.transition(first, boundary), DF(), transitions + i);
    }
}

void LocateInColumns(YuyvView image, int from_y, std::size_t from, std::size_t to, ColumnChanges& changes) {
    const DI d;
    const std::uint8_t* base = image.row(from_y);
    const I stride = hn::Set(d, image.stride);
    const I end = hn::Set(d, image.height - 1);
    for (std::size_t i = from; i < to; i += hn::Lanes(d)) {
        const I boundary = hn::LoadU(d, changes.y.data() + i);
        const I pair = hn::LoadU(d, changes.pair.data() + i);
        const auto odd = hn::MaskFromVec(hn::LoadU(d, changes.odd.data() + i));
        const I before = reach(hn::LoadU(d, changes.length_before.data() + i));
        const I after = reach(hn::LoadU(d, changes.length_after.data() + i));
        const I first = hn::Max(hn::Zero(d), hn::Sub(boundary, before));
        const I last = hn::Min(end, hn::Sub(hn::Add(boundary, after), hn::Set(d, 1)));
        const auto valid = hn::FirstN(d, to - i);
        const auto offset = [&](I y) {
            return hn::IfThenElseZero(valid, hn::Add(pair, hn::Mul(stride, hn::Sub(y, hn::Set(d, from_y)))));
        };
        const I last_at = offset(last);
        I at = offset(first);
        Pixels window[6];
        for (Pixels& each : window) {
            each = pixels(gather(base, hn::Min(at, last_at)), odd);
            at = hn::Add(at, stride);
        }
        const I beyond = hn::Add(last, hn::Set(d, 1));
        Edges edges(window[0], window[5]);
        for (int k = 0; k < 6; ++k) {
            const I y = hn::Add(first, hn::Set(d, k));
            edges.add(window[k].y, edges.chroma_share(window[k].cb, window[k].cr),
                      hn::RebindMask(DF(), hn::Lt(y, beyond)));
        }
        hn::StoreU(edges.transition(first, boundary), DF(), changes.transition.data() + i);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace goalmouth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(LocateInRow);
HWY_EXPORT(LocateInColumns);

namespace {

/// Rows farther apart than this put a window's pixels beyond what a vector's 32-bit offsets reach.
constexpr int widest_stride = (1 << 30) / band_height;  // bytes

int window_reach(int length) {
    return length <= 2 ? 3 : std::min(3, (length + 1) / 2);
}

float locate_alone(YuyvView image, const ColumnChanges& changes, std::size_t i) {
    const int x = changes.pair[i] / 2 - changes.odd[i];
    const TransitionWindow window{window_reach(changes.length_before[i]),
                                  window_reach(changes.length_after[i])};
    const float nominal = static_cast<float>(changes.y[i]) - 0.5F;
    const float found = locate_transition(image, Orientation::vertical, x, changes.y[i], window);
    return nominal + std::round(100.F * std::clamp(found - nominal, -1.27F, 1.27F)) / 100.F;
}

}  // namespace

void locate_row_transitions(const std::uint8_t* row, int width, std::size_t count, const std::int32_t* starts,
                            float* transitions) {
    transitions[0] = -0.5F;
    HWY_DYNAMIC_DISPATCH(LocateInRow)(row, width, count, starts, transitions);
}

void locate_column_transitions(YuyvView image, int from_y, std::size_t first, std::size_t last,
                               ColumnChanges& changes) {
    if (image.stride > widest_stride) {
        for (std::size_t i = first; i < last; ++i) changes.transition[i] = locate_alone(image, changes, i);
        return;
    }
    HWY_DYNAMIC_DISPATCH(LocateInColumns)(image, from_y, first, last, changes);
}

}  // namespace goalmouth
#endif
