#include "core/segmentation/label_changes.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/segmentation/label_changes.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

std::size_t FindChanges(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                        std::int32_t* positions) {
    const hn::CappedTag<std::uint8_t, 64> d;  // so that a mask fits one word
    std::int32_t* out = positions;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto changed = hn::Ne(hn::LoadU(d, a + i), hn::LoadU(d, b + i));
        if (HWY_LIKELY(hn::AllFalse(d, changed))) continue;
        HWY_ALIGN std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, changed, bytes);
        std::uint64_t bits = 0;
        for (int k = 7; k >= 0; --k) bits = bits << 8 | bytes[k];
        if (count - i < 64) bits &= (std::uint64_t{1} << (count - i)) - 1;
        for (; bits != 0; bits &= bits - 1)
            *out++ = static_cast<std::int32_t>(i + hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
    }
    return static_cast<std::size_t>(out - positions);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace goalmouth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(FindChanges);

std::size_t find_changes(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                         std::int32_t* positions) {
    return HWY_DYNAMIC_DISPATCH(FindChanges)(a, b, count, positions);
}

}  // namespace goalmouth
#endif
