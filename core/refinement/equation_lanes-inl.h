// EquationSums of a lane's terms: included once for each kind of vector (Highway's foreach_target.h).

#if defined(GOALMOUTH_EQUATION_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GOALMOUTH_EQUATION_LANES_INL_H
#undef GOALMOUTH_EQUATION_LANES_INL_H
#else
#define GOALMOUTH_EQUATION_LANES_INL_H
#endif

#include "core/refinement/equation_sums.h"

#include <cstddef>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

using Doubles = hwy::HWY_NAMESPACE::CappedTag<double, LaneSums::lanes>;
using DoubleVector = hwy::HWY_NAMESPACE::Vec<Doubles>;

// No fused multiply-add: every kind of vector gives the same numbers.
class EquationLanes {
  public:
    HWY_INLINE EquationLanes() {
        const auto zero = hwy::HWY_NAMESPACE::Zero(Doubles());
        for (DoubleVector& sum : information_) sum = zero;
        for (DoubleVector& sum : pull_) sum = zero;
    }

    /// Σ w jᵀ and Σ w t.
    HWY_INLINE void add(const DoubleVector (&w)[4], const DoubleVector (&j)[4], DoubleVector t) {
        namespace hn = hwy::HWY_NAMESPACE;
        DoubleVector* sum = information_;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t k = i; k < 4; ++k, ++sum) *sum = hn::Add(*sum, hn::Mul(w[i], j[k]));
            pull_[i] = hn::Add(pull_[i], hn::Mul(w[i], t));
        }
    }

    /// As those from `lane` on.
    HWY_INLINE void store(std::size_t lane, EquationSums& sums) const {
        namespace hn = hwy::HWY_NAMESPACE;
        for (std::size_t i = 0; i < 10; ++i)
            hn::Store(information_[i], Doubles(), sums.information[i].parts + lane);
        for (std::size_t i = 0; i < 4; ++i) hn::Store(pull_[i], Doubles(), sums.pull[i].parts + lane);
    }

  private:
    DoubleVector information_[10], pull_[4];
};

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
