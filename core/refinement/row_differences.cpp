#include "core/refinement/row_differences.h"

#include <cstring>

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/row_differences.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, RowDifferences::room>;
using FloatVector = hn::Vec<Floats>;
using Words = hn::Rebind<std::uint32_t, Floats>;

HWY_INLINE hn::Vec<Words> load_pairs(const std::uint8_t* pairs) {
#if HWY_TARGET == HWY_SCALAR
    std::uint32_t word = 0;
    std::memcpy(&word, pairs, sizeof(word));
    return hn::Set(Words(), word);
#else
    return hn::BitCast(Words(), hn::LoadU(hn::Repartition<std::uint8_t, Floats>(), pairs));
#endif
}

template <int shift>
HWY_INLINE FloatVector byte_of(hn::Vec<Words> word) {
    const auto byte = hn::And(hn::ShiftRight<shift>(word), hn::Set(Words(), 255U));
    return hn::ConvertTo(Floats(), hn::BitCast(hn::RebindToSigned<Floats>(), byte));
}

// No fused multiply-add: every kind of vector gives the same numbers.
HWY_INLINE FloatVector three(FloatVector x, FloatVector y, FloatVector z, float a, float b, float c) {
    const Floats d;
    return hn::Add(hn::Add(hn::Mul(x, hn::Set(d, a)), hn::Mul(y, hn::Set(d, b))), hn::Mul(z, hn::Set(d, c)));
}

void row_differences(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pairs,
                     const PostColour& colour, RowDifferences& differences) {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    const Eigen::Matrix3f& m = colour.contrast;
    const auto half = hn::Set(d, 0.5F);
    for (std::size_t i = 0; i < pairs; i += lanes) {
        // Whole vectors; of the last one those before are worked on once more.
        const std::size_t at = i + lanes <= pairs ? i : pairs >= lanes ? pairs - lanes : 0;
        hn::Vec<Words> one, other;
        if (pairs >= lanes) {
            one = load_pairs(upper + 4 * at);
            other = load_pairs(lower + 4 * at);
        } else {
            alignas(64) std::uint8_t few[2][4 * RowDifferences::room] = {};
            for (std::size_t k = 0; k < 4 * pairs; ++k) few[0][k] = upper[k], few[1][k] = lower[k];
            one = load_pairs(few[0]);
            other = load_pairs(few[1]);
        }
        const auto luma = hn::Add(hn::Add(byte_of<0>(one), byte_of<16>(one)),
                                  hn::Add(byte_of<0>(other), byte_of<16>(other)));
        const auto cb = hn::Add(byte_of<8>(one), byte_of<8>(other));
        const auto cr = hn::Add(byte_of<24>(one), byte_of<24>(other));
        const auto y = hn::Sub(hn::Mul(luma, hn::Set(d, 0.25F)), hn::Set(d, colour.mean[0]));
        const auto u = hn::Sub(hn::Sub(hn::Mul(cb, half), hn::Set(d, 128.0F)), hn::Set(d, colour.mean[1]));
        const auto v = hn::Sub(hn::Sub(hn::Mul(cr, half), hn::Set(d, 128.0F)), hn::Set(d, colour.mean[2]));
        const auto wy = three(y, u, v, m(0, 0), m(0, 1), m(0, 2));
        const auto wu = three(y, u, v, m(1, 0), m(1, 1), m(1, 2));
        const auto wv = three(y, u, v, m(2, 0), m(2, 1), m(2, 2));
        const auto all = hn::Add(hn::Mul(y, wy), hn::Add(hn::Mul(u, wu), hn::Mul(v, wv)));
        const auto dark = hn::Lt(hn::Mul(luma, hn::Set(d, 0.25F)), hn::Set(d, colour.darkest));
        hn::StoreU(hn::IfThenElse(dark, hn::Set(d, PostColour::too_dark), all), d,
                   differences.difference.data() + at);
    }
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(row_differences);

void row_differences(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pairs,
                     const PostColour& colour, RowDifferences& differences) {
    HWY_DYNAMIC_DISPATCH(row_differences)(upper, lower, pairs, colour, differences);
}

}  // namespace goalmouth
#endif
