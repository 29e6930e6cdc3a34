#include "core/random/samples.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/random/samples.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
using Words = hn::CappedTag<std::uint64_t, 8>;
using Halves = hn::Repartition<std::uint32_t, Words>;
using WordVector = hn::Vec<Words>;

/// The product of the lower halves.
HWY_INLINE WordVector multiply_halves(WordVector a, WordVector b) {
    return hn::MulEven(hn::BitCast(Halves(), a), hn::BitCast(Halves(), b));
}

HWY_INLINE WordVector multiply(WordVector a, std::uint64_t factor) {
    const Words d;
    const auto lower = hn::Set(d, factor & 0xFFFFFFFFU);
#if HWY_TARGET <= HWY_AVX3
    return hn::Mul(a, hn::Set(d, factor));
#else
    const auto crossed =
        hn::Add(multiply_halves(hn::ShiftRight<32>(a), lower), multiply_halves(a, hn::Set(d, factor >> 32)));
    return hn::Add(multiply_halves(a, lower), hn::ShiftLeft<32>(crossed));
#endif
}

void draw_pairs(std::uint64_t key, std::uint64_t place, std::uint32_t count, std::size_t pairs,
                std::uint64_t* HWY_RESTRICT drawn) {
    constexpr std::uint64_t step = 0x9e3779b97f4a7c15U;
    const Words d;
    const auto all = hn::Set(d, count);
    const auto others = hn::Set(d, count - 1);
    auto state = hn::Add(hn::Set(d, key + (place + 1) * step), multiply(hn::Iota(d, 0), step));
    const auto behind = hn::Set(d, hn::Lanes(d) * step);
    for (std::size_t i = 0; i < pairs; i += hn::Lanes(d)) {
        auto z = multiply(hn::Xor(state, hn::ShiftRight<30>(state)), 0xbf58476d1ce4e5b9U);
        z = multiply(hn::Xor(z, hn::ShiftRight<27>(z)), 0x94d049bb133111ebU);
        z = hn::Xor(z, hn::ShiftRight<31>(z));
        const auto first = hn::ShiftRight<32>(multiply_halves(hn::ShiftRight<32>(z), all));
        const auto other = hn::ShiftRight<32>(multiply_halves(z, others));
        // One more unless it is less than the first, which is what the sign of the difference says.
        const auto less = hn::ShiftRight<63>(hn::Sub(other, first));
        const auto second = hn::Sub(hn::Add(other, hn::Set(d, 1)), less);
        hn::StoreU(hn::Or(first, hn::ShiftLeft<32>(second)), d, drawn + i);
        state = hn::Add(state, behind);
    }
}
#else
void draw_pairs(std::uint64_t key, std::uint64_t place, std::uint32_t count, std::size_t pairs,
                std::uint64_t* drawn) {
    for (std::size_t i = 0; i < pairs; ++i) {
        const auto [first, second] = draw_sample<2>(key, place + i, count);
        drawn[i] = first | (std::uint64_t{second} << 32);
    }
}
#endif

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(draw_pairs);

void draw_pairs(std::uint64_t key, std::uint64_t place, std::uint32_t count, std::size_t pairs,
                std::uint64_t* drawn) {
    HWY_DYNAMIC_DISPATCH(draw_pairs)(key, place, count, pairs, drawn);
}

}  // namespace goalmouth
#endif
