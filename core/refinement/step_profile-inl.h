// StepProfile in lanes: included once for each kind of vector (Highway's foreach_target.h).

#if defined(GOALMOUTH_STEP_PROFILE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GOALMOUTH_STEP_PROFILE_INL_H
#undef GOALMOUTH_STEP_PROFILE_INL_H
#else
#define GOALMOUTH_STEP_PROFILE_INL_H
#endif

#include "core/refinement/lanes-inl.h"
#include "core/refinement/step_profile.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

/// StepProfile::at() for a place in each lane.
class EdgePieces {
  public:
    struct Place {
        hwy::HWY_NAMESPACE::Vec<Integers> piece;  // in numbers of the table
        FloatVector way;                          // px from the piece's start
    };

    HWY_INLINE explicit EdgePieces(const StepProfile& profile)
        : reach_(profile.reach()),
          per_px_(profile.per_px()),
          end_(static_cast<float>(profile.count()) - 0.5F),
          tables_(profile.tables()) {}

    HWY_INLINE Place place(FloatVector x) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const Floats d;
        const auto from =
            hn::Add(hn::Mul(hn::Add(x, hn::Set(d, reach_)), hn::Set(d, per_px_)), hn::Set(d, 1.0F));
        const auto at = hn::Min(hn::Max(from, hn::Zero(d)), hn::Set(d, end_));
        const auto piece = hn::ConvertTo(Integers(), at);
        const auto way = hn::Mul(hn::Sub(at, hn::ConvertTo(d, piece)), hn::Set(d, 1.0F / per_px_));
        return {piece, way};
    }

    /// E and dE/dx.
    HWY_INLINE void step(const Place& p, FloatVector& step, FloatVector& slope) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const auto c0 = look_up(0, p), c1 = look_up(1, p), c2 = look_up(2, p), c3 = look_up(3, p);
        const auto bend = hn::Mul(p.way, c3);
        const auto inner = hn::Add(c2, bend);
        step = hn::Add(c0, hn::Mul(p.way, hn::Add(c1, hn::Mul(p.way, inner))));
        // c1 + 2·c2·x + 3·c3·x²
        slope = hn::Add(c1, hn::Mul(p.way, hn::Add(hn::Add(inner, inner), bend)));
    }

    /// dE/dσ and E_d − E_o.
    HWY_INLINE void blur(const Place& p, FloatVector& blur, FloatVector& digital) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const auto b0 = look_up(StepProfile::blur_factors, p), b1 = look_up(StepProfile::blur_factors + 1, p);
        const auto d0 = look_up(StepProfile::digital_factors, p);
        const auto d1 = look_up(StepProfile::digital_factors + 1, p);
        blur = hn::Add(b0, hn::Mul(p.way, b1));
        digital = hn::Add(d0, hn::Mul(p.way, d1));
    }

  private:
    /// One number of the polynomials of each lane's piece.
    HWY_INLINE FloatVector look_up(std::size_t number, const Place& p) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const Floats d;
        const float* const numbers = tables_[number].data();
#if HWY_TARGET <= HWY_AVX3
        // All of them fit two vectors; looking there takes one instruction.
        static_assert(2 * EdgeRows::block == StepProfile::most_pieces);
        return hn::Vec<Floats>{_mm512_permutex2var_ps(hn::Load(d, numbers).raw, p.piece.raw,
                                                      hn::Load(d, numbers + EdgeRows::block).raw)};
#else
        return hn::GatherIndex(d, numbers, p.piece);
#endif
    }

    float reach_;
    float per_px_;
    float end_;
    const StepProfile::Tables& tables_;
};

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
