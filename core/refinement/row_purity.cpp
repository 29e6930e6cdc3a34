#include "core/refinement/row_purity.h"

#include <bit>
#include <cstdint>
#include <limits>

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/row_purity.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>
//
#include "core/refinement/step_profile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void judge_rows(EdgeRows& rows, const StepProfile& profile, float outwards) {
    constexpr float well_inside = 0.03F, well_outside = 0.97F;
    constexpr float farthest_out = 6.0F;  // px: farther out something else may lie
    constexpr float farthest_offset = 3.0F, least_luma = 16.0F;
    const Floats d;
    const EdgePieces pieces(profile);
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F), two = hn::Set(d, 2.0F);
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(d)) {
        const EdgeRows::Pixels& pixels = rows.pixels[row / EdgeRows::block];
        const std::size_t lane = row % EdgeRows::block;
        const auto pairs = hn::LoadU(d, rows.pairs.data() + row);
        const auto offset =
            hn::Max(hn::Min(hn::LoadU(d, rows.measured.offset.data() + row), hn::Set(d, farthest_offset)),
                    hn::Set(d, -farthest_offset));
        alignas(64) float from[EdgeRows::block];
        for (std::size_t k = 0; k < hn::Lanes(d); ++k)
            from[k] = rows.pairs[row + k] > 0.0F
                          ? outwards * static_cast<float>(rows.first[row + k] - rows.edge[row + k])
                          : 0.0F;
        const auto start = hn::Sub(hn::Load(d, from), offset);
        LaneSum aa, ab, bb, ra, rb, rr;
        LaneSum inner, inner_pairs, outer, outer_pairs, mixed, mixed_share, mixed_luma;
        const auto most = static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(d, pairs)));
        for (std::size_t i = 0; i < most; ++i) {
            const auto there = hn::Lt(hn::Set(d, static_cast<float>(i)), pairs);
            const auto x = hn::Add(start, hn::Set(d, 2.0F * outwards * static_cast<float>(i)));
            FloatVector step, slope;
            pieces.step(pieces.place(x), step, slope);
            const auto out = hn::IfThenElseZero(there, step);
            const auto in = hn::IfThenElseZero(there, hn::Sub(one, step));
            const auto r = hn::IfThenElseZero(there, hn::Load(d, pixels.stray[i].data() + lane));
            aa.add(in, in), ab.add(in, out), bb.add(out, out);
            ra.add(r, in), rb.add(r, out), rr.add(r, r);

            const auto luma = hn::Load(d, pixels.luma[i].data() + lane);
            const auto is_inner = hn::And(there, hn::Lt(step, hn::Set(d, well_inside)));
            const auto is_outer = hn::And(there, hn::Gt(step, hn::Set(d, well_outside)));
            const auto counts_out = hn::And(is_outer, hn::Lt(x, hn::Set(d, farthest_out)));
            const auto is_mixed = hn::AndNot(hn::Or(is_inner, is_outer), there);
            inner.add(hn::IfThenElseZero(is_inner, luma));
            inner_pairs.add(hn::IfThenElseZero(is_inner, one));
            outer.add(hn::IfThenElseZero(counts_out, luma));
            outer_pairs.add(hn::IfThenElseZero(counts_out, one));
            mixed.add(hn::IfThenElseZero(is_mixed, one));
            mixed_share.add(hn::IfThenElseZero(is_mixed, step));
            mixed_luma.add(hn::IfThenElseZero(is_mixed, luma));
        }
        const auto little = hn::Set(d, 1e-3F);
        const auto naa = hn::Add(aa.all, little), nbb = hn::Add(bb.all, little);
        const auto det = hn::Sub(hn::Mul(naa, nbb), hn::Mul(ab.all, ab.all));
        const auto cross = hn::Mul(hn::Mul(two, ab.all), hn::Mul(ra.all, rb.all));
        const auto explained = hn::Div(hn::Add(hn::Sub(hn::Mul(nbb, hn::Mul(ra.all, ra.all)), cross),
                                               hn::Mul(naa, hn::Mul(rb.all, rb.all))),
                                       det);
        const auto stray =
            hn::Div(hn::Max(zero, hn::Sub(rr.all, explained)), hn::Max(one, hn::Sub(pairs, two)));
        hn::StoreU(stray, d, rows.stray.data() + row);

        const auto told = hn::And(hn::Gt(inner_pairs.all, zero), hn::Gt(outer_pairs.all, zero));
        const auto inside = hn::Div(inner.all, hn::Max(inner_pairs.all, one));
        const auto outside = hn::Div(outer.all, hn::Max(outer_pairs.all, one));
        const auto expected =
            hn::Add(hn::Mul(mixed.all, inside), hn::Mul(mixed_share.all, hn::Sub(outside, inside)));
        const auto dark =
            hn::Div(hn::Mul(two, hn::Sub(expected, mixed_luma.all)), hn::Max(inside, hn::Set(d, least_luma)));
        hn::StoreU(hn::IfThenElseZero(told, dark), d, rows.dark.data() + row);
    }
}

HWY_INLINE hn::Mask<Floats> told_rows(const EdgeRows& rows, std::ptrdiff_t row) {
    const Floats d;
    const auto seen = hn::Gt(hn::LoadU(d, rows.pairs.data() + row), hn::Zero(d));
    return hn::And(seen, hn::Gt(hn::LoadU(d, rows.measured.information.data() + row), hn::Zero(d)));
}

void local_means(const EdgeRows& rows, const RowColumn<float>& part, std::size_t reach,
                 RowColumn<float>& means) {
    const Floats d;
    const auto to = static_cast<std::ptrdiff_t>(reach);
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(d)) {
        auto sum = hn::Zero(d), count = hn::Zero(d);
        for (std::ptrdiff_t k = -to; k <= to; ++k) {
            const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row) + k;
            const auto told = told_rows(rows, at);
            sum = hn::Add(sum, hn::IfThenElseZero(told, hn::LoadU(d, part.data() + at)));
            count = hn::Add(count, hn::IfThenElseZero(told, hn::Set(d, 1.0F)));
        }
        hn::StoreU(hn::Div(sum, hn::Max(count, hn::Set(d, 1.0F))), d, means.data() + row);
    }
}

/// 0 where it is usual, 1 where it is another thing's.
HWY_INLINE FloatVector beyond(FloatVector part, const Unusual& unusual) {
    const Floats d;
    return hn::Mul(hn::Sub(part, hn::Set(d, unusual.usual)),
                   hn::Set(d, 1.0F / (unusual.most - unusual.usual)));
}

void weigh_rows(const UsualRows& usual, const LocalRows& local, EdgeRows& rows) {
    const Floats d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(d)) {
        const auto told = told_rows(rows, static_cast<std::ptrdiff_t>(row));
        auto clean = one;
        if (usual.gate) {
            // What lies behind a post or before it does so in several rows, and where it begins and ends it
            // disturbs less than can be seen in one row.
            const auto load = [&](const RowColumn<float>& column)
                                  HWY_ATTR { return hn::LoadU(d, column.data() + row); };
            auto worst = beyond(hn::Abs(hn::Sub(load(local.dark), hn::Set(d, usual.shading))), usual.dark);
            worst = hn::Max(hn::Max(worst, zero), beyond(load(rows.measured.misfit), usual.misfit));
            worst = hn::Max(worst, beyond(load(local.misfit), usual.misfits));
            worst = hn::Max(worst, beyond(load(rows.stray), usual.stray));
            worst = hn::Max(worst, beyond(load(local.stray), usual.strays));
            clean = hn::Max(zero, hn::Sub(one, hn::Mul(worst, worst)));
        }
        clean = hn::IfThenElseZero(told, hn::Mul(clean, clean));
        hn::StoreU(clean, d, rows.clean.data() + row);
        const auto information = hn::LoadU(d, rows.measured.information.data() + row);
        const auto variance =
            hn::Add(hn::Div(one, hn::IfThenElse(told, information, one)), hn::Set(d, usual.least_variance));
        const auto offset = hn::LoadU(d, rows.measured.offset.data() + row);
        const auto most = hn::Mul(variance, hn::Set(d, usual.farthest * usual.farthest));
        const auto near = hn::Max(zero, hn::Sub(one, hn::Div(hn::Mul(offset, offset), most)));
        const auto kept = hn::Eq(hn::LoadU(d, rows.outvoted.data() + row), zero);
        hn::StoreU(hn::IfThenElseZero(kept, hn::Mul(hn::Mul(near, near), clean)), d,
                   rows.weight.data() + row);
    }
}

float nth_smallest(const float* numbers, std::size_t count, std::size_t n) {
    // Quarter by quarter of what is left of the range: in which of them is it? Numbers' bits are in the order
    // of the numbers once those of negative ones are turned over.
    const hn::RebindToUnsigned<Floats> u;
    const hn::RebindToSigned<Floats> s;
    const Floats d;
    constexpr std::uint32_t sign = 0x80000000U;
    const auto largest = hn::Set(s, std::numeric_limits<std::int32_t>::max());
    const auto at = [&](std::size_t i) HWY_ATTR {
        const auto bits = hn::BitCast(s, hn::LoadU(d, numbers + i));
        // Turned over where negative, but for the sign: in the order of whole numbers.
        return hn::Xor(bits, hn::BitCast(s, hn::ShiftRight<1>(hn::BitCast(u, hn::BroadcastSignBit(bits)))));
    };
    const auto limit = [&](std::uint32_t number)
                           HWY_ATTR { return hn::Set(s, static_cast<std::int32_t>(number ^ sign)); };
    const auto whole = [](std::int32_t ordered) { return static_cast<std::uint32_t>(ordered) ^ sign; };

    auto least = largest, most = hn::Not(largest);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto lanes = hn::FirstN(s, count - i);
        const auto number = at(i);
        least = hn::Min(least, hn::IfThenElse(lanes, number, largest));
        most = hn::Max(most, hn::IfThenElse(lanes, number, hn::Not(largest)));
    }
    const std::uint32_t first = whole(hn::GetLane(hn::MinOfLanes(s, least)));
    const std::uint32_t last = whole(hn::GetLane(hn::MaxOfLanes(s, most)));
    int open = (std::bit_width(first ^ last) + 1) / 2 * 2;  // bits in which they differ
    std::uint32_t found = open < 32 ? first >> open << open : 0;
    std::size_t before = 0, behind = count;  // numbers less than the range's first; than what comes after it
    while (open > 0 && behind - before > 1) {
        open -= 2;
        const std::uint32_t step = std::uint32_t{1} << open;
        const auto one = limit(found + step), two = limit(found + 2 * step), three = limit(found + 3 * step);
        std::size_t below_one = 0, below_two = 0, below_three = 0;
        for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
            const auto lanes = hn::FirstN(s, count - i);
            const auto number = at(i);
            below_one += hn::CountTrue(s, hn::And(lanes, hn::Lt(number, one)));
            below_two += hn::CountTrue(s, hn::And(lanes, hn::Lt(number, two)));
            below_three += hn::CountTrue(s, hn::And(lanes, hn::Lt(number, three)));
        }
        if (below_two <= n) {
            const bool fourth = below_three <= n;
            found += (fourth ? 3 : 2) * step;
            before = fourth ? below_three : below_two;
            behind = fourth ? behind : below_three;
        } else {
            const bool second = below_one <= n;
            found += second ? step : 0;
            before = second ? below_one : before;
            behind = second ? below_two : below_one;
        }
    }
    if (open > 0) {
        // One number is left, the first from here on.
        const auto from = limit(found);
        auto next = largest;
        for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
            const auto lanes = hn::FirstN(s, count - i);
            const auto number = at(i);
            next = hn::Min(next, hn::IfThenElse(hn::AndNot(hn::Lt(number, from), lanes), number, largest));
        }
        found = whole(hn::GetLane(hn::MinOfLanes(s, next)));
    }
    const std::uint32_t ordered = found ^ sign;
    const std::uint32_t bits = (ordered & sign) != 0 ? ordered ^ 0x7fffffffU : ordered;
    return std::bit_cast<float>(bits);
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(judge_rows);
HWY_EXPORT(local_means);
HWY_EXPORT(weigh_rows);
HWY_EXPORT(nth_smallest);

void judge_rows(EdgeRows& rows, const StepProfile& profile, float outwards) {
    HWY_DYNAMIC_DISPATCH(judge_rows)(rows, profile, outwards);
}

void local_means(const EdgeRows& rows, const RowColumn<float>& part, std::size_t reach,
                 RowColumn<float>& means) {
    HWY_DYNAMIC_DISPATCH(local_means)(rows, part, reach, means);
}

void weigh_rows(const UsualRows& usual, const LocalRows& local, EdgeRows& rows) {
    HWY_DYNAMIC_DISPATCH(weigh_rows)(usual, local, rows);
}

float nth_smallest(const float* numbers, std::size_t count, std::size_t n) {
    return HWY_DYNAMIC_DISPATCH(nth_smallest)(numbers, count, n);
}

}  // namespace goalmouth
#endif
