#include "core/refinement/step_equations.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/step_equations.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

namespace goalmouth {
#ifndef GOALMOUTH_ROW_SUMS
#define GOALMOUTH_ROW_SUMS
/// Sums over every eighth row, so that they do not depend on how long vectors are.
struct RowSums {
    static constexpr std::size_t lanes = 8, information = 10, pull = 4;
    alignas(64) double parts[information + pull][lanes];
};
#endif
}  // namespace goalmouth

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No fused multiply-add: every kind of vector gives the same numbers.
using Doubles = hn::CappedTag<double, RowSums::lanes>;
using Singles = hn::Rebind<float, Doubles>;
using DoubleVector = hn::Vec<Doubles>;

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
              double roughness, RowSums& sums) {
    const Doubles d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
    for (std::size_t lane = 0; lane < RowSums::lanes; lane += hn::Lanes(d)) {
        auto h00 = zero, h01 = zero, h02 = zero, h03 = zero, h11 = zero, h12 = zero, h13 = zero, h22 = zero,
             h23 = zero, h33 = zero, g0 = zero, g1 = zero, g2 = zero, g3 = zero;
        for (std::size_t row = lane; row < rows.count; row += RowSums::lanes) {
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
            const auto j0 = part(0), j1 = part(1), j2 = part(2), j3 = part(3);
            const auto variance = hn::Add(hn::Div(one, hn::IfThenElse(counts, information, one)),
                                          hn::Set(d, roughness * roughness));
            const auto w = hn::IfThenElseZero(counts, hn::Div(weight, variance));
            const auto t =
                hn::Min(hn::Max(scaled(wide(rows.measured.offset, row), outwards), hn::Set(d, -most)),
                        hn::Set(d, most));
            const auto w0 = hn::Mul(w, j0), w1 = hn::Mul(w, j1), w2 = hn::Mul(w, j2), w3 = hn::Mul(w, j3);
            h00 = hn::Add(h00, hn::Mul(w0, j0)), h01 = hn::Add(h01, hn::Mul(w0, j1));
            h02 = hn::Add(h02, hn::Mul(w0, j2)), h03 = hn::Add(h03, hn::Mul(w0, j3));
            h11 = hn::Add(h11, hn::Mul(w1, j1)), h12 = hn::Add(h12, hn::Mul(w1, j2));
            h13 = hn::Add(h13, hn::Mul(w1, j3)), h22 = hn::Add(h22, hn::Mul(w2, j2));
            h23 = hn::Add(h23, hn::Mul(w2, j3)), h33 = hn::Add(h33, hn::Mul(w3, j3));
            g0 = hn::Add(g0, hn::Mul(w0, t)), g1 = hn::Add(g1, hn::Mul(w1, t));
            g2 = hn::Add(g2, hn::Mul(w2, t)), g3 = hn::Add(g3, hn::Mul(w3, t));
        }
        hn::Store(h00, d, sums.parts[0] + lane), hn::Store(h01, d, sums.parts[1] + lane);
        hn::Store(h02, d, sums.parts[2] + lane), hn::Store(h03, d, sums.parts[3] + lane);
        hn::Store(h11, d, sums.parts[4] + lane), hn::Store(h12, d, sums.parts[5] + lane);
        hn::Store(h13, d, sums.parts[6] + lane), hn::Store(h22, d, sums.parts[7] + lane);
        hn::Store(h23, d, sums.parts[8] + lane), hn::Store(h33, d, sums.parts[9] + lane);
        hn::Store(g0, d, sums.parts[10] + lane), hn::Store(g1, d, sums.parts[11] + lane);
        hn::Store(g2, d, sums.parts[12] + lane), hn::Store(g3, d, sums.parts[13] + lane);
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
    RowSums sums;
    HWY_DYNAMIC_DISPATCH(add_rows)(rows, plane.data(), change.data(), outwards, most, edge_roughness, sums);
    const auto total = [&](std::size_t part) {
        double sum = 0.0;
        for (const double p : sums.parts[part]) sum += p;
        return sum;
    };
    std::size_t part = 0;
    for (int i = 0; i < 4; ++i)
        for (int k = i; k < 4; ++k) {
            const double sum = total(part++);
            equations.information(i, k) += sum;
            if (k != i) equations.information(k, i) += sum;
        }
    for (int i = 0; i < 4; ++i) equations.pull[i] += total(part++);
}

}  // namespace goalmouth
#endif
