#include "core/refinement/level_smoother.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/level_smoother.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>
//
#include "core/refinement/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Of the levels of some rows, less that of the row they are for: sums of their weights, and by weight.
struct Sums {
    FloatVector weight, value, square, count;

    HWY_INLINE Sums() : weight(hn::Zero(Floats())), value(weight), square(weight), count(weight) {}
    HWY_INLINE void add(const float* levels, const float* weights, FloatVector own) {
        const Floats d;
        const auto w = hn::LoadU(d, weights);
        const auto v = hn::Sub(hn::LoadU(d, levels), own);
        const auto wv = hn::Mul(w, v);
        weight = hn::Add(weight, w);
        value = hn::Add(value, wv);
        square = hn::Add(square, hn::Mul(wv, v));
        count = hn::Add(count, hn::IfThenElseZero(hn::Gt(w, hn::Zero(d)), hn::Set(d, 1.0F)));
    }
    HWY_INLINE void add(const Sums& other) {
        weight = hn::Add(weight, other.weight);
        value = hn::Add(value, other.value);
        square = hn::Add(square, other.square);
        count = hn::Add(count, other.count);
    }
};

/// What they come to.
struct Found {
    hn::Mask<Floats> some;
    FloatVector mean;        // less the row's own level
    FloatVector per_weight;  // one over their weight
    FloatVector count;
    FloatVector real;    // scatter that noise does not explain
    FloatVector unlike;  // square of what the row's own level is off by, less its noise; may be negative

    HWY_INLINE Found(const Sums& sums, FloatVector noise, FloatVector own_variance) {
        const Floats d;
        const auto one = hn::Set(d, 1.0F);
        some = hn::Gt(sums.weight, hn::Set(d, 0.5F));
        per_weight = hn::Div(one, hn::IfThenElse(some, sums.weight, one));
        mean = hn::Mul(sums.value, per_weight);
        const auto square = hn::Mul(mean, mean);
        const auto scatter = hn::Sub(hn::Mul(sums.square, per_weight), square);
        count = sums.count;
        real = hn::Max(hn::Zero(d), hn::Sub(scatter, hn::Mul(noise, hn::Mul(count, per_weight))));
        unlike = hn::Sub(square, own_variance);
    }
};

HWY_INLINE void choose(hn::Mask<Floats> changes, const Found& side, Found& best) {
    const auto better = hn::And(hn::And(changes, side.some),
                                hn::Lt(hn::Add(side.real, side.unlike), hn::Add(best.real, best.unlike)));
    best.mean = hn::IfThenElse(better, side.mean, best.mean);
    best.per_weight = hn::IfThenElse(better, side.per_weight, best.per_weight);
    best.count = hn::IfThenElse(better, side.count, best.count);
    best.real = hn::IfThenElse(better, side.real, best.real);
    best.unlike = hn::IfThenElse(better, side.unlike, best.unlike);
}

HWY_INLINE void smooth_side(std::size_t rows, std::size_t reach, float noise_variance,
                            const RowColumn<float>& own, const RowColumn<float>& own_weight,
                            RowColumn<float>& level, RowColumn<float>& variance) {
    const Floats d;
    const auto noise = hn::Set(d, noise_variance);
    for (std::size_t i = 0; i < rows; i += hn::Lanes(d)) {
        const float* const levels = own.data() + i;
        const float* const weights = own_weight.data() + i;
        const auto here = hn::LoadU(d, levels);
        const auto per_own = hn::Div(hn::Set(d, 1.0F), hn::Max(hn::Set(d, 0.25F), hn::LoadU(d, weights)));
        const auto own_variance = hn::Mul(noise, per_own);
        Sums above, below;
        for (std::size_t k = 1; k <= reach; ++k) {
            above.add(levels - k, weights - k, here);
            below.add(levels + k, weights + k, here);
        }
        Sums both = above;
        both.add(below);
        Found best(both, noise, own_variance);
        const auto usual = hn::Mul(hn::Set(d, 10.0F),
                                   hn::Mul(noise, hn::Add(hn::Mul(best.count, best.per_weight), per_own)));
        const auto changes = hn::And(best.some, hn::Gt(hn::Max(best.real, best.unlike), usual));
        if (!hn::AllFalse(d, changes)) {
            for (std::size_t k = reach + 1; k <= 2 * reach; ++k) {
                above.add(levels - k, weights - k, here);
                below.add(levels + k, weights + k, here);
            }
            choose(changes, Found(above, noise, own_variance), best);
            choose(changes, Found(below, noise, own_variance), best);
        }
        constexpr float unknown = 1e4F;
        const auto off = hn::Max(hn::Zero(d), hn::Sub(best.unlike, hn::Mul(hn::Set(d, 6.0F), own_variance)));
        const auto spread = hn::Add(hn::Add(best.real, off), hn::Mul(noise, best.per_weight));
        hn::StoreU(hn::Add(here, hn::IfThenElseZero(best.some, best.mean)), d, level.data() + i);
        hn::StoreU(hn::IfThenElse(best.some, spread, hn::Set(d, unknown)), d, variance.data() + i);
    }
}

void smooth_levels(EdgeRows& rows, float noise) {
    constexpr std::size_t inner_reach = 12, outer_reach = 6;
    static_assert(2 * inner_reach + EdgeRows::block <= RowColumn<float>::room);
    smooth_side(rows.count, inner_reach, noise, rows.measured.own_inner, rows.measured.own_inner_weight,
                rows.inner, rows.inner_variance);
    smooth_side(rows.count, outer_reach, noise, rows.measured.own_outer, rows.measured.own_outer_weight,
                rows.outer, rows.outer_variance);
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(smooth_levels);

void smooth_levels(EdgeRows& rows, float noise) {
    HWY_DYNAMIC_DISPATCH(smooth_levels)(rows, noise);
}

}  // namespace goalmouth
#endif
