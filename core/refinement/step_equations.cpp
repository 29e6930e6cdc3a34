#include "core/refinement/step_equations.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/step_equations.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include "core/refinement/equation_lanes-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Singles = hn::Rebind<float, Doubles>;

HWY_INLINE DoubleVector scaled(DoubleVector a, double b) {
    return hn::Mul(a, hn::Set(Doubles(), b));
}

HWY_INLINE DoubleVector wide(const RowColumn<float>& column, std::size_t row) {
    return hn::PromoteTo(Doubles(), hn::LoadU(Singles(), column.data() + row));
}

HWY_INLINE DoubleVector load(const RowColumn<double>& column, std::size_t row) {
    return hn::LoadU(Doubles(), column.data() + row);
}

/// How much n·ray grows for each px along the row.
HWY_INLINE DoubleVector per_px(const EdgeRows& rows, const double* plane, std::size_t row) {
    return hn::Add(scaled(load(rows.slope_x, row), plane[0]), scaled(load(rows.slope_y, row), plane[1]));
}

void place_edges(const double* plane, EdgeRows& rows) {
    const Doubles d;
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(d)) {
        const auto off =
            hn::Add(hn::Add(scaled(load(rows.ray_x, row), plane[0]), scaled(load(rows.ray_y, row), plane[1])),
                    hn::Set(d, plane[2]));
        const auto slope = per_px(rows, plane, row);
        const auto there = hn::Ne(slope, hn::Zero(d));
        const auto edge =
            hn::Sub(load(rows.column, row), hn::Div(off, hn::IfThenElse(there, slope, hn::Set(d, 1.0))));
        hn::StoreU(hn::IfThenElseZero(there, edge), d, rows.edge.data() + row);
    }
}

void add_rows(const EdgeRows& rows, const double* plane, const double* change, double outwards, double most,
              double roughness, EquationSums& sums) {
    const Doubles d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
    for (std::size_t lane = 0; lane < LaneSums::lanes; lane += hn::Lanes(d)) {
        EquationLanes equations;
        for (std::size_t row = lane; row < rows.count; row += LaneSums::lanes) {
            const auto weight = wide(rows.weight, row), information = wide(rows.measured.information, row);
            const auto counts = hn::And(hn::Gt(weight, zero), hn::Gt(information, zero));
            if (hn::AllFalse(d, counts)) continue;
            const auto miss = hn::Sub(load(rows.edge, row), load(rows.column, row));
            const auto x = hn::Add(load(rows.ray_x, row), hn::Mul(miss, load(rows.slope_x, row)));
            const auto y = hn::Add(load(rows.ray_y, row), hn::Mul(miss, load(rows.slope_y, row)));
            const auto inverse = hn::Neg(hn::Div(one, hn::IfThenElse(counts, per_px(rows, plane, row), one)));
            const auto part = [&](int k) HWY_ATTR {  // dn/dstep, column by column
                const auto along = hn::Add(scaled(x, change[3 * k]), scaled(y, change[3 * k + 1]));
                // Of a row that does not count the column may be no number.
                return hn::IfThenElseZero(counts,
                                          hn::Mul(inverse, hn::Add(along, hn::Set(d, change[3 * k + 2]))));
            };
            const DoubleVector j[4] = {part(0), part(1), part(2), part(3)};
            const auto variance = hn::Add(hn::Div(one, hn::IfThenElse(counts, information, one)),
                                          hn::Set(d, roughness * roughness));
            const auto w = hn::IfThenElseZero(counts, hn::Div(weight, variance));
            const auto t =
                hn::Min(hn::Max(scaled(wide(rows.measured.offset, row), outwards), hn::Set(d, -most)),
                        hn::Set(d, most));
            const DoubleVector weighted[4] = {hn::Mul(w, j[0]), hn::Mul(w, j[1]), hn::Mul(w, j[2]),
                                              hn::Mul(w, j[3])};
            equations.add(weighted, j, t);
        }
        equations.store(lane, sums);
    }
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(place_edges);
HWY_EXPORT(add_rows);

void place_edges(const Eigen::Vector3d& plane, EdgeRows& rows) {
    HWY_DYNAMIC_DISPATCH(place_edges)(plane.data(), rows);
}

void add_rows(const EdgeRows& rows, const Eigen::Vector3d& plane, const Eigen::Matrix<double, 3, 4>& change,
              double outwards, double most, StepEquations& equations) {
    EquationSums sums;
    HWY_DYNAMIC_DISPATCH(add_rows)(rows, plane.data(), change.data(), outwards, most, edge_roughness, sums);
    equations.information += sums.total_information();
    equations.pull += sums.total_pull();
}

}  // namespace goalmouth
#endif
