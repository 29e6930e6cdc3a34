#include "core/refinement/end_equations.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/end_equations.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

namespace goalmouth {
#ifndef GOALMOUTH_END_SUMS
#define GOALMOUTH_END_SUMS
/// Sums over every eighth value, so that they do not depend on how long vectors are.
struct EndSums {
    static constexpr std::size_t lanes = 8, information = 10, pull = 4;
    alignas(64) double parts[information + pull + 1][lanes];
};
#endif
}  // namespace goalmouth

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No fused multiply-add: every kind of vector gives the same numbers.
void end_equations(const double* way, const double* value, std::size_t count, const EndStep& step,
                   const NormalTable& normal, EndSums& sums) {
    const hn::CappedTag<double, EndSums::lanes> d;
    const hn::RebindToSigned<decltype(d)> whole_numbers;
    using Vector = hn::Vec<decltype(d)>;
    const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
    const auto zero = hn::Zero(d), one = set(1.0), half = set(0.5);
    const auto height = set(step.outer - step.inner), per_sigma = set(1.0 / NormalTable::per_sigma);
    for (std::size_t lane = 0; lane < EndSums::lanes; lane += hn::Lanes(d)) {
        auto h00 = zero, h01 = zero, h02 = zero, h03 = zero, h11 = zero, h12 = zero, h13 = zero, h22 = zero,
             h23 = zero, h33 = zero, g0 = zero, g1 = zero, g2 = zero, g3 = zero, squares = zero;
        for (std::size_t i = lane; i < count; i += EndSums::lanes) {
            const auto there = hn::FirstN(d, count - i);
            const auto z = hn::Div(hn::Sub(hn::LoadU(d, way + i), set(step.place)), set(step.blur));
            // NormalTable::at().
            const auto place = hn::Min(
                set(2.0 * NormalTable::middle),
                hn::Max(zero, hn::Add(hn::Mul(z, set(NormalTable::per_sigma)), set(NormalTable::middle))));
            const auto nearest = hn::ConvertTo(whole_numbers, hn::Add(place, half));
            const auto whole = hn::ConvertTo(d, nearest);
            const auto here = hn::Mul(hn::Sub(whole, set(NormalTable::middle)), per_sigma);
            const auto off = hn::Mul(hn::Sub(place, whole), per_sigma);
            const auto at_nearest = hn::GatherIndex(d, normal.density(), nearest);
            const auto below =
                hn::Add(hn::GatherIndex(d, normal.below(), nearest),
                        hn::Mul(hn::Mul(off, at_nearest), hn::Sub(one, hn::Mul(hn::Mul(half, off), here))));
            const auto bend = hn::Mul(hn::Mul(half, off), hn::Sub(one, hn::Mul(here, here)));
            const auto density = hn::Mul(at_nearest, hn::Sub(one, hn::Mul(off, hn::Add(here, bend))));

            const auto slope = hn::Mul(density, height);
            const auto in = hn::Sub(one, below);
            const auto level = hn::Add(set(step.inner), hn::Mul(height, below));
            const auto only = [&](Vector v) HWY_ATTR { return hn::IfThenElseZero(there, v); };
            const auto miss = only(hn::Sub(hn::LoadU(d, value + i), level));
            const auto j0 = only(hn::Neg(hn::Div(slope, set(step.blur))));
            const auto j1 = only(hn::Neg(hn::Mul(slope, z)));
            const auto j2 = only(in), j3 = only(below);
            h00 = hn::Add(h00, hn::Mul(j0, j0)), h01 = hn::Add(h01, hn::Mul(j0, j1));
            h02 = hn::Add(h02, hn::Mul(j0, j2)), h03 = hn::Add(h03, hn::Mul(j0, j3));
            h11 = hn::Add(h11, hn::Mul(j1, j1)), h12 = hn::Add(h12, hn::Mul(j1, j2));
            h13 = hn::Add(h13, hn::Mul(j1, j3)), h22 = hn::Add(h22, hn::Mul(j2, j2));
            h23 = hn::Add(h23, hn::Mul(j2, j3)), h33 = hn::Add(h33, hn::Mul(j3, j3));
            g0 = hn::Add(g0, hn::Mul(miss, j0)), g1 = hn::Add(g1, hn::Mul(miss, j1));
            g2 = hn::Add(g2, hn::Mul(miss, j2)), g3 = hn::Add(g3, hn::Mul(miss, j3));
            squares = hn::Add(squares, hn::Mul(miss, miss));
        }
        const Vector all[] = {h00, h01, h02, h03, h11, h12, h13, h22, h23, h33, g0, g1, g2, g3, squares};
        for (std::size_t part = 0; part < EndSums::information + EndSums::pull + 1; ++part)
            hn::Store(all[part], d, sums.parts[part] + lane);
    }
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(end_equations);

EndEquations end_equations(const RowColumn<double>& way, const RowColumn<double>& value, std::size_t count,
                           const EndStep& step, const NormalTable& normal) {
    EndSums sums;
    HWY_DYNAMIC_DISPATCH(end_equations)(way.data(), value.data(), count, step, normal, sums);
    const auto total = [&](std::size_t part) {
        double sum = 0.0;
        for (const double p : sums.parts[part]) sum += p;
        return sum;
    };
    EndEquations equations;
    std::size_t part = 0;
    for (int i = 0; i < 4; ++i)
        for (int k = i; k < 4; ++k) equations.information(i, k) = equations.information(k, i) = total(part++);
    for (int i = 0; i < 4; ++i) equations.pull[i] = total(part++);
    equations.squares = total(part);
    return equations;
}

}  // namespace goalmouth
#endif
