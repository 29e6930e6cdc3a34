// StepProfile in lanes: included once for each kind of vector (Highway's foreach_target.h).

#if defined(GOALMOUTH_STEP_PROFILE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GOALMOUTH_STEP_PROFILE_INL_H
#undef GOALMOUTH_STEP_PROFILE_INL_H
#else
#define GOALMOUTH_STEP_PROFILE_INL_H
#endif

#include "core/refinement/edge_rows.h"
#include "core/refinement/step_profile.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

using Floats = hwy::HWY_NAMESPACE::CappedTag<float, EdgeRows::block>;
using FloatVector = hwy::HWY_NAMESPACE::Vec<Floats>;
using Integers = hwy::HWY_NAMESPACE::RebindToSigned<Floats>;

/// StepProfile::at() for a place in each lane.
class EdgePieces {
  public:
    struct Place {
        hwy::HWY_NAMESPACE::Vec<Integers> piece;  // in numbers of the table
        FloatVector way;                          // px from the piece's start
    };

    HWY_INLINE explicit EdgePieces(const StepProfile& profile)
        : table_(profile.pieces().front().step.data()),
          reach_(profile.reach()),
          end_(static_cast<float>(profile.pieces().size()) - 0.5F) {
        static_assert(sizeof(StepProfile::Piece) == numbers * sizeof(float));
    }

    HWY_INLINE Place place(FloatVector x) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const Floats d;
        const auto from = hn::Add(hn::Mul(hn::Add(x, hn::Set(d, reach_)), hn::Set(d, StepProfile::per_px)),
                                  hn::Set(d, 1.0F));
        const auto at = hn::Min(hn::Max(from, hn::Zero(d)), hn::Set(d, end_));
        const auto piece = hn::ConvertTo(Integers(), at);
        const auto way =
            hn::Mul(hn::Sub(at, hn::ConvertTo(d, piece)), hn::Set(d, 1.0F / StepProfile::per_px));
        return {hn::ShiftLeft<3>(piece), way};
    }

    /// E and dE/dx.
    HWY_INLINE void step(const Place& p, FloatVector& step, FloatVector& slope) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const Floats d;
        const auto c0 = hn::GatherIndex(d, table_, p.piece), c1 = hn::GatherIndex(d, table_ + 1, p.piece);
        const auto c2 = hn::GatherIndex(d, table_ + 2, p.piece), c3 = hn::GatherIndex(d, table_ + 3, p.piece);
        const auto bend = hn::Mul(p.way, c3);
        const auto inner = hn::Add(c2, bend);
        step = hn::Add(c0, hn::Mul(p.way, hn::Add(c1, hn::Mul(p.way, inner))));
        // c1 + 2·c2·x + 3·c3·x²
        slope = hn::Add(c1, hn::Mul(p.way, hn::Add(hn::Add(inner, inner), bend)));
    }

    /// dE/dσ and E_d − E_o.
    HWY_INLINE void blur(const Place& p, FloatVector& blur, FloatVector& digital) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const Floats d;
        const auto b0 = hn::GatherIndex(d, table_ + 4, p.piece), b1 = hn::GatherIndex(d, table_ + 5, p.piece);
        const auto d0 = hn::GatherIndex(d, table_ + 6, p.piece), d1 = hn::GatherIndex(d, table_ + 7, p.piece);
        blur = hn::Add(b0, hn::Mul(p.way, b1));
        digital = hn::Add(d0, hn::Mul(p.way, d1));
    }

  private:
    static constexpr std::size_t numbers = 8;
    const float* table_;
    float reach_;
    float end_;
};

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
