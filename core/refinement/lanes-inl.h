// Numbers of a row of an edge in each lane: included once for each kind of vector (Highway's
// foreach_target.h).

#if defined(GOALMOUTH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GOALMOUTH_LANES_INL_H
#undef GOALMOUTH_LANES_INL_H
#else
#define GOALMOUTH_LANES_INL_H
#endif

#include "core/refinement/edge_rows.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

using Floats = hwy::HWY_NAMESPACE::CappedTag<float, EdgeRows::block>;
using FloatVector = hwy::HWY_NAMESPACE::Vec<Floats>;
using Integers = hwy::HWY_NAMESPACE::RebindToSigned<Floats>;

/// A sum over a row's pairs. No fused multiply-add: every kind of vector gives the same numbers.
struct LaneSum {
    FloatVector all;

    HWY_INLINE LaneSum() : all(hwy::HWY_NAMESPACE::Zero(Floats())) {}
    HWY_INLINE void add(FloatVector a) { all = hwy::HWY_NAMESPACE::Add(all, a); }
    HWY_INLINE void add(FloatVector a, FloatVector b) {
        all = hwy::HWY_NAMESPACE::Add(all, hwy::HWY_NAMESPACE::Mul(a, b));
    }
};

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
