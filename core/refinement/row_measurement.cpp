#include "core/refinement/row_measurement.h"

#include <algorithm>

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/row_measurement.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>
//
#include "core/refinement/step_profile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <bool with_blur>
HWY_INLINE void measure_lanes(const EdgeRows& rows, const EdgePieces& pieces, const SupposedEdges& edges,
                              float outwards, float noise, std::size_t row, RowMeasurements& measured,
                              BlurRows* blur) {
    const Floats d;
    const EdgeRows::Pixels& pixels = rows.pixels[row / EdgeRows::block];
    const std::size_t lane = row % EdgeRows::block;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F), most_share = hn::Set(d, 0.9F);
    const auto pairs = hn::LoadU(d, rows.pairs.data() + row);
    const auto a = hn::LoadU(d, rows.inner.data() + row), b = hn::LoadU(d, rows.outer.data() + row);
    const auto height = hn::Sub(b, a);
    const auto start = hn::LoadU(d, edges.start.data() + row);
    const auto across = hn::LoadU(d, edges.across.data() + row);
    const auto narrow = hn::Gt(across, zero);
    const bool any_narrow = !hn::AllFalse(d, narrow);
    const auto beyond = hn::Sub(hn::LoadU(d, rows.other_edge.data() + row), a);

    LaneSum tt, ta, tb, aa, ab, bb, rt, ra, rb, rr;
    LaneSum ss, sd, dd, rs, rd, ts, td, sa, sb, da, db;
    LaneSum inner, inner_weight, outer, outer_weight;
    const auto most = static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(d, pairs)));
    for (std::size_t i = 0; i < most; ++i) {
        const auto there = hn::Lt(hn::Set(d, static_cast<float>(i)), pairs);
        const auto x = hn::Add(start, hn::Set(d, 2.0F * outwards * static_cast<float>(i)));
        const EdgePieces::Place place = pieces.place(x);
        FloatVector step, slope;
        pieces.step(place, step, slope);
        auto value = hn::Load(d, pixels.value[i].data() + lane);
        if (any_narrow) {
            FloatVector other, unused;
            pieces.step(pieces.place(hn::Sub(hn::Neg(x), across)), other, unused);
            value = hn::Sub(value, hn::IfThenElseZero(narrow, hn::Mul(beyond, other)));
        }
        const auto far_out = hn::And(there, hn::Gt(step, most_share));
        const auto in_all = hn::Sub(one, step);
        const auto far_in = hn::And(there, hn::Gt(in_all, most_share));
        outer.add(hn::IfThenElseZero(far_out, step), hn::Sub(value, hn::Mul(in_all, a)));
        outer_weight.add(hn::IfThenElseZero(far_out, step), step);
        inner.add(hn::IfThenElseZero(far_in, in_all), hn::Sub(value, hn::Mul(step, b)));
        inner_weight.add(hn::IfThenElseZero(far_in, in_all), in_all);

        const auto r = hn::IfThenElseZero(there, hn::Sub(hn::Sub(value, a), hn::Mul(height, step)));
        const auto t = hn::IfThenElseZero(there, hn::Neg(hn::Mul(height, slope)));
        const auto in = hn::IfThenElseZero(there, in_all);
        const auto out = hn::IfThenElseZero(there, step);
        tt.add(t, t), ta.add(t, in), tb.add(t, out);
        aa.add(in, in), ab.add(in, out), bb.add(out, out);
        rt.add(r, t), ra.add(r, in), rb.add(r, out), rr.add(r, r);
        if constexpr (with_blur) {
            FloatVector by_blur, by_digital;
            pieces.blur(place, by_blur, by_digital);
            const auto s = hn::IfThenElseZero(there, hn::Mul(height, by_blur));
            const auto g = hn::IfThenElseZero(there, hn::Mul(height, by_digital));
            ss.add(s, s), sd.add(s, g), dd.add(g, g), rs.add(r, s), rd.add(r, g), ts.add(t, s), td.add(t, g);
            sa.add(s, in), sb.add(s, out), da.add(g, in), db.add(g, out);
        }
    }
    const auto mean_or = [&](const LaneSum& sum, const LaneSum& weight, FloatVector other) HWY_ATTR {
        const auto some = hn::Gt(weight.all, zero);
        return hn::IfThenElse(some, hn::Div(sum.all, hn::IfThenElse(some, weight.all, one)), other);
    };
    hn::StoreU(mean_or(inner, inner_weight, a), d, measured.own_inner.data() + row);
    hn::StoreU(mean_or(outer, outer_weight, b), d, measured.own_outer.data() + row);
    hn::StoreU(inner_weight.all, d, measured.own_inner_weight.data() + row);
    hn::StoreU(outer_weight.all, d, measured.own_outer_weight.data() + row);

    // Levels eliminated; everything in units of the noise's variance.
    const auto n = hn::Set(d, noise), least_variance = hn::Set(d, 1e-6F);
    const auto known = [&](const RowColumn<float>& variance) HWY_ATTR {
        return hn::Div(n, hn::Max(hn::LoadU(d, variance.data() + row), least_variance));
    };
    // What lies far from the edge tells of levels alone.
    LaneSum known_in = aa, known_out = bb;
    const auto far = [&](const RowColumn<float>& mean, const RowColumn<float>& weight, FloatVector level,
                         LaneSum& information, LaneSum& pull) HWY_ATTR {
        const auto w = hn::LoadU(d, weight.data() + row);
        information.add(w);
        pull.add(w, hn::Sub(hn::LoadU(d, mean.data() + row), level));
    };
    far(rows.far_inner, rows.far_inner_weight, a, known_in, ra);
    far(rows.far_outer, rows.far_outer_weight, b, known_out, rb);
    const auto naa = hn::Add(known_in.all, known(rows.inner_variance));
    const auto nbb = hn::Add(known_out.all, known(rows.outer_variance));
    const auto per_det = hn::Div(one, hn::Sub(hn::Mul(naa, nbb), hn::Mul(ab.all, ab.all)));
    const auto ia = hn::Mul(nbb, per_det), iab = hn::Neg(hn::Mul(ab.all, per_det)),
               ib = hn::Mul(naa, per_det);
    const auto two = [&](FloatVector p, FloatVector q, FloatVector u, FloatVector v)
                         HWY_ATTR { return hn::Add(hn::Mul(p, q), hn::Mul(u, v)); };
    const auto ca = two(ia, ta.all, iab, tb.all), cb = two(iab, ta.all, ib, tb.all);
    const auto left = hn::Sub(tt.all, two(ta.all, ca, tb.all, cb));
    constexpr float largest = 1e30F;
    const auto told =
        hn::And(hn::Gt(pairs, zero), hn::And(hn::Gt(left, zero), hn::Lt(left, hn::Set(d, largest))));
    const auto per_left = hn::Div(one, hn::IfThenElse(told, left, one));
    const auto reduced = hn::Sub(rt.all, two(ca, ra.all, cb, rb.all));
    const auto offset = hn::IfThenElseZero(told, hn::Mul(reduced, per_left));
    hn::StoreU(offset, d, measured.offset.data() + row);
    hn::StoreU(hn::IfThenElseZero(told, hn::Div(left, n)), d, measured.information.data() + row);
    const auto la = two(ia, ra.all, iab, rb.all), lb = two(iab, ra.all, ib, rb.all);
    // Degrees of freedom: those of the levels are the less, the better the neighbours know them.
    const auto of_levels =
        hn::Add(two(ia, aa.all, ib, bb.all), hn::Mul(hn::Set(d, 2.0F), hn::Mul(iab, ab.all)));
    const auto freedom = hn::Max(one, hn::Sub(hn::Sub(pairs, one), of_levels));
    const auto rest = hn::Sub(hn::Sub(rr.all, two(ra.all, la, rb.all, lb)), hn::Mul(reduced, offset));
    hn::StoreU(freedom, d, measured.freedom.data() + row);
    hn::StoreU(hn::IfThenElseZero(told, hn::Div(hn::Max(zero, rest), freedom)), d,
               measured.misfit.data() + row);
    if constexpr (with_blur) {
        // The same for what they say about the blur, levels and offset eliminated.
        const auto s_a = two(ia, sa.all, iab, sb.all), s_b = two(iab, sa.all, ib, sb.all);
        const auto d_a = two(ia, da.all, iab, db.all), d_b = two(iab, da.all, ib, db.all);
        const auto st = hn::Sub(ts.all, two(sa.all, ca, sb.all, cb));
        const auto dt = hn::Sub(td.all, two(da.all, ca, db.all, cb));
        const auto per_noise = hn::Div(one, n);
        const auto store = [&](FloatVector all, FloatVector levels, FloatVector by_offset,
                               RowColumn<float>& column) HWY_ATTR {
            const auto own = hn::Sub(hn::Sub(all, levels), by_offset);
            hn::StoreU(hn::IfThenElseZero(told, hn::Mul(own, per_noise)), d, column.data() + row);
        };
        store(ss.all, two(sa.all, s_a, sb.all, s_b), hn::Mul(hn::Mul(st, st), per_left), blur->blur);
        store(sd.all, two(sa.all, d_a, sb.all, d_b), hn::Mul(hn::Mul(st, dt), per_left), blur->shared);
        store(dd.all, two(da.all, d_a, db.all, d_b), hn::Mul(hn::Mul(dt, dt), per_left), blur->digital);
        store(rs.all, two(ra.all, s_a, rb.all, s_b), hn::Mul(st, offset), blur->blur_pull);
        store(rd.all, two(ra.all, d_a, rb.all, d_b), hn::Mul(dt, offset), blur->digital_pull);
    }
}

void measure_rows(const EdgeRows& rows, const StepProfile& profile, const SupposedEdges& edges,
                  float outwards, float noise, const std::vector<bool>* blocks, RowMeasurements& measured,
                  BlurRows* blur) {
    const EdgePieces pieces(profile);
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(Floats())) {
        if (blocks != nullptr && !(*blocks)[row / EdgeRows::block]) continue;
        if (blur != nullptr)
            measure_lanes<true>(rows, pieces, edges, outwards, noise, row, measured, blur);
        else
            measure_lanes<false>(rows, pieces, edges, outwards, noise, row, measured, nullptr);
    }
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(measure_rows);

void measure_rows(const EdgeRows& rows, const StepProfile& profile, const SupposedEdges& edges,
                  float outwards, float noise, const std::vector<bool>* blocks, RowMeasurements& measured,
                  BlurRows* blur) {
    HWY_DYNAMIC_DISPATCH(measure_rows)(rows, profile, edges, outwards, noise, blocks, measured, blur);
}

void BlurRows::assign(std::size_t rows) {
    for (RowColumn<float>* column : {&blur, &shared, &digital, &blur_pull, &digital_pull})
        column->assign(rows);
}

BlurEvidence BlurRows::evidence(const EdgeRows& rows) const {
    BlurEvidence sum;
    for (std::size_t i = 0; i < rows.count; ++i) {
        const auto w = static_cast<double>(rows.weight[i]);
        sum.information(0, 0) += w * static_cast<double>(blur[i]);
        sum.information(0, 1) += w * static_cast<double>(shared[i]);
        sum.information(1, 1) += w * static_cast<double>(digital[i]);
        sum.pull[0] += w * static_cast<double>(blur_pull[i]);
        sum.pull[1] += w * static_cast<double>(digital_pull[i]);
    }
    sum.information(1, 0) = sum.information(0, 1);
    return sum;
}

}  // namespace goalmouth
#endif
