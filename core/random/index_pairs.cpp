#include "core/random/index_pairs.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/random/index_pairs.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
/// Random::index() of draws that are to be accepted: low(product) ≥ count. Returns the least low(product).
std::uint32_t finish_index_pairs(std::uint32_t count, std::size_t draws, const std::uint64_t* first,
                                 const std::uint64_t* last, std::uint64_t* indices) {
    const hn::CappedTag<std::uint64_t, 8> d;
    const hn::Repartition<std::uint32_t, decltype(d)> halves;
    const auto counts = hn::OddEven(hn::Set(d, count - 1), hn::Set(d, count));
    const auto upper = hn::Set(d, 0xFFFFFFFF00000000U);
    const auto none = hn::Set(d, std::numeric_limits<std::uint64_t>::max());
    auto least = hn::BitCast(halves, none);
    for (std::size_t i = 0; i < draws; i += hn::Lanes(d)) {
        const auto a = hn::Load(d, first + i);
        const auto bits = hn::Add(hn::RotateRight<64 - 23>(hn::Add(a, hn::Load(d, last + i))), a);
        const auto product =
            hn::MulEven(hn::BitCast(halves, hn::ShiftRight<32>(bits)), hn::BitCast(halves, counts));
        const auto low = hn::IfThenElse(hn::FirstN(d, draws - i), hn::Or(product, upper), none);
        least = hn::Min(least, hn::BitCast(halves, low));
        hn::StoreU(hn::ShiftRight<32>(product), d, indices + i);
    }
    return hn::GetLane(hn::MinOfLanes(halves, least));
}
#else
std::uint32_t finish_index_pairs(std::uint32_t count, std::size_t draws, const std::uint64_t* first,
                                 const std::uint64_t* last, std::uint64_t* indices) {
    std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
    for (std::size_t i = 0; i < draws; ++i) {
        const std::uint64_t bits = std::rotl(first[i] + last[i], 23) + first[i];
        const std::uint64_t product = (bits >> 32) * (i % 2 == 0 ? count : count - 1);
        least = std::min(least, static_cast<std::uint32_t>(product));
        indices[i] = product >> 32;
    }
    return least;
}
#endif

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(finish_index_pairs);

void draw_index_pairs(Random& random, std::uint32_t count, std::size_t pairs, std::uint64_t* indices) {
    constexpr std::size_t most = 64;
    constexpr std::size_t room = 8;
    alignas(64) std::uint64_t first[2 * most + room];
    alignas(64) std::uint64_t last[2 * most + room];
    for (std::size_t done = 0; done < pairs; done += most, indices += 2 * most) {
        const std::size_t draws = 2 * std::min(most, pairs - done);
        const Random before = random;
        random.skip(draws, first, last);
        if (HWY_DYNAMIC_DISPATCH(finish_index_pairs)(count, draws, first, last, indices) >= count) continue;
        // Some draw may be one that index() repeats: once in millions of times for as many points as a
        // picture has.
        random = before;
        for (std::size_t i = 0; i < draws; i += 2) {
            indices[i] = random.index(count);
            indices[i + 1] = random.index(count - 1);
        }
    }
}

}  // namespace goalmouth
#endif
