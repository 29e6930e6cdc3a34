#include "core/refinement/end_equations.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/end_equations.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include "core/refinement/equation_lanes-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No fused multiply-add: every kind of vector gives the same numbers.
void end_equations(const double* way, const double* value, std::size_t count, const EndStep& step,
                   const NormalTable& normal, EquationSums& sums, LaneSums& squares) {
    const Doubles d;
    const hn::RebindToSigned<Doubles> whole_numbers;
    const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
    const auto zero = hn::Zero(d), one = set(1.0), half = set(0.5);
    const auto height = set(step.outer - step.inner), per_sigma = set(1.0 / NormalTable::per_sigma);
    for (std::size_t lane = 0; lane < LaneSums::lanes; lane += hn::Lanes(d)) {
        EquationLanes equations;
        auto left = zero;
        for (std::size_t i = lane; i < count; i += LaneSums::lanes) {
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
            const auto level = hn::Add(set(step.inner), hn::Mul(height, below));
            const auto only = [&](DoubleVector v) HWY_ATTR { return hn::IfThenElseZero(there, v); };
            const auto miss = only(hn::Sub(hn::LoadU(d, value + i), level));
            const DoubleVector j[4] = {only(hn::Neg(hn::Div(slope, set(step.blur)))),
                                       only(hn::Neg(hn::Mul(slope, z))), only(hn::Sub(one, below)),
                                       only(below)};
            equations.add(j, j, miss);
            left = hn::Add(left, hn::Mul(miss, miss));
        }
        equations.store(lane, sums);
        hn::Store(left, d, squares.parts + lane);
    }
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(end_equations);

EndEquations end_equations(const RowColumn<double>& way, const RowColumn<double>& value, std::size_t count,
                           const EndStep& step, const NormalTable& normal) {
    EquationSums sums;
    LaneSums squares;
    HWY_DYNAMIC_DISPATCH(end_equations)(way.data(), value.data(), count, step, normal, sums, squares);
    return {sums.total_information(), sums.total_pull(), squares.total()};
}

}  // namespace goalmouth
#endif
