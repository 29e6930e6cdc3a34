#include "core/detection/line_scoring.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/detection/line_scoring.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float shortest_sample = 4.0F;  // of the grid

using Floats = hn::CappedTag<float, room_behind_points>;
using Integers = hn::RebindToSigned<Floats>;
using Shorts = hn::CappedTag<std::int16_t, 2 * room_behind_points>;
using IntegerVector = hn::Vec<Integers>;
using ShortVector = hn::Vec<Shorts>;

/// Without the digits behind the point, and each number twice, so that a load of 32 bits fills all lanes with
/// it.
HWY_INLINE void round_points(const GridPoint* HWY_RESTRICT points, std::size_t count,
                             GridPoint* HWY_RESTRICT rounded) {
    const Integers n;
    const auto half = hn::Set(n, 0x8000);
    const auto upper = hn::Set(n, -0x10000);
    const std::int32_t* const from = &points->x;
    std::int32_t* const to = &rounded->x;
    for (std::size_t i = 0; i < 2 * count; i += hn::Lanes(n)) {
        const auto v = hn::And(hn::Add(hn::LoadU(n, from + i), half), upper);
        const auto lower =
            hn::BitCast(n, hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<Integers>(), v)));
        hn::StoreU(hn::Or(v, lower), n, to + i);
    }
}

/// Lines on the grid, one for each sample: normal · p = offset · 2^15, normals not longer than 2^15.
struct Hypotheses {
    alignas(64) std::int16_t normal_x[LineSamples::most];
    alignas(64) std::int16_t normal_y[LineSamples::most];
    alignas(64) std::int16_t offset[LineSamples::most];
};

/// What rounds a number of less than 2^22 to a whole one when it is added: it stands in the lower digits
/// then.
constexpr float whole_number = 0x1.8p23F;

/// The lower 16 bits of such sums.
HWY_INLINE void store_whole(hn::Vec<Floats> sum, std::int16_t* to) {
    const hn::Rebind<std::uint16_t, Integers> words;
    hn::StoreU(hn::TruncateTo(words, hn::BitCast(hn::RebindToUnsigned<Integers>(), sum)), words,
               reinterpret_cast<std::uint16_t*>(to));
}

HWY_INLINE void lines_through(const LineSamples& samples, Hypotheses& lines) {
    const Integers n;
    const Floats f;
    // Shorter than this the digits behind the point do not suffice for a direction.
    const auto least = hn::Set(f, shortest_sample * shortest_sample * 0x1p32F);
    // Less than 2^15 by the share that the approximate root may be wrong.
    const auto unit = hn::Set(f, 32500.0F);
    const auto whole = hn::Set(f, whole_number);
    for (std::size_t i = 0; i < samples.count; i += hn::Lanes(n)) {
        IntegerVector x;
        IntegerVector y;
        IntegerVector to_x;
        IntegerVector to_y;
        hn::LoadInterleaved2(n, &samples.first[i].x, x, y);
        hn::LoadInterleaved2(n, &samples.second[i].x, to_x, to_y);
        const auto along_x = hn::ConvertTo(f, hn::Sub(to_x, x));
        const auto along_y = hn::ConvertTo(f, hn::Sub(to_y, y));
        const auto square = hn::MulAdd(along_x, along_x, hn::Mul(along_y, along_y));
        // With no normal it is a line that every point lies on.
        const auto shorten =
            hn::IfThenElseZero(hn::Ge(square, least), hn::Mul(hn::ApproximateReciprocalSqrt(square), unit));
        const auto normal_x = hn::MulAdd(along_y, shorten, whole);
        const auto normal_y = hn::NegMulAdd(along_x, shorten, whole);
        const auto along_normal = hn::MulAdd(hn::Sub(normal_x, whole), hn::ConvertTo(f, x),
                                             hn::Mul(hn::Sub(normal_y, whole), hn::ConvertTo(f, y)));
        store_whole(normal_x, lines.normal_x + i);
        store_whole(normal_y, lines.normal_y + i);
        store_whole(hn::MulAdd(along_normal, hn::Set(f, 0x1p-31F), whole), lines.offset + i);
    }
}

/// `count` and one more in the lanes of the mask.
HWY_INLINE ShortVector count_lanes(hn::Mask<Shorts> mask, ShortVector count) {
    const Shorts s;
#if HWY_TARGET <= HWY_AVX3
    return hn::IfThenElse(mask, hn::Add(count, hn::Set(s, 1)), count);
#else
    return hn::Sub(count, hn::VecFromMask(s, mask));
#endif
}

/// Some lines, one in each lane.
struct LineLanes {
    ShortVector normal_x;
    ShortVector normal_y;
    ShortVector start;  // what is here or less than 2 · near behind is near, with no more than one comparison

    HWY_INLINE LineLanes(ShortVector to_x, ShortVector to_y, ShortVector offset, std::int16_t near)
        : normal_x(to_x),
          normal_y(to_y),
          start(hn::Sub(offset, hn::Set(Shorts(), static_cast<std::int16_t>(near - 1 - 32768)))) {}
    HWY_INLINE LineLanes(const Hypotheses& lines, std::size_t i, std::int16_t near)
        : LineLanes(hn::Load(Shorts(), lines.normal_x + i), hn::Load(Shorts(), lines.normal_y + i),
                    hn::Load(Shorts(), lines.offset + i), near) {}

    /// Which lines pass the point near.
    HWY_INLINE hn::Mask<Shorts> is_near(ShortVector x, ShortVector y, ShortVector end) const {
        const auto along = hn::Add(hn::MulFixedPoint15(normal_x, x), hn::MulFixedPoint15(normal_y, y));
        return hn::Lt(hn::Sub(along, start), end);
    }
};

/// A rounded number, which is in both halves.
HWY_INLINE ShortVector in_all_lanes(std::int32_t twice) {
    const Shorts s;
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(s, static_cast<std::int16_t>(twice));
#else
    return hn::BitCast(s, hn::Set(hn::Repartition<std::int32_t, Shorts>(), twice));
#endif
}

/// The counts of the points near to some vectors of lines.
template <std::size_t vectors>
HWY_INLINE void count_lanes_near(const Hypotheses& lines, std::size_t first, std::int16_t near,
                                 const GridPoint* HWY_RESTRICT points, std::size_t count,
                                 std::uint16_t* HWY_RESTRICT counts) {
    const Shorts s;
    const std::size_t lanes = hn::Lanes(s);
    const auto end = hn::Set(s, static_cast<std::int16_t>(2 * near - 1 - 32768));
    const LineLanes a(lines, first, near);
    const LineLanes b(lines, first + (vectors > 1 ? lanes : 0), near);
    const LineLanes c(lines, first + (vectors > 2 ? 2 * lanes : 0), near);
    auto count_a = hn::Zero(s);
    auto count_b = hn::Zero(s);
    auto count_c = hn::Zero(s);
    for (std::size_t p = 0; p < count; ++p) {
        const auto x = in_all_lanes(points[p].x);
        const auto y = in_all_lanes(points[p].y);
        count_a = count_lanes(a.is_near(x, y, end), count_a);
        if constexpr (vectors > 1) count_b = count_lanes(b.is_near(x, y, end), count_b);
        if constexpr (vectors > 2) count_c = count_lanes(c.is_near(x, y, end), count_c);
    }
    const hn::RebindToUnsigned<Shorts> u;
    hn::Store(hn::BitCast(u, count_a), u, counts + first);
    if constexpr (vectors > 1) hn::Store(hn::BitCast(u, count_b), u, counts + first + lanes);
    if constexpr (vectors > 2) hn::Store(hn::BitCast(u, count_c), u, counts + first + 2 * lanes);
}

#if HWY_TARGET != HWY_SCALAR
/// The same for one line, with a point in each two lanes.
HWY_INLINE std::uint16_t count_points_near(const Hypotheses& lines, std::size_t i, std::int16_t near,
                                           const GridPoint* HWY_RESTRICT points, std::size_t count) {
    const Shorts s;
    const Integers n;
    const std::size_t at_once = hn::Lanes(n);
    const auto end = hn::Set(s, static_cast<std::int16_t>(2 * near - 1 - 32768));
    const LineLanes line(hn::Set(s, lines.normal_x[i]), hn::Set(s, lines.normal_y[i]),
                         hn::Set(s, lines.offset[i]), near);
    auto sum = hn::Zero(n);
    for (std::size_t p = 0; p < count; p += at_once) {
        IntegerVector x;
        IntegerVector y;
        hn::LoadInterleaved2(n, &points[p].x, x, y);
        const auto is_near =
            hn::BitCast(n, hn::VecFromMask(s, line.is_near(hn::BitCast(s, x), hn::BitCast(s, y), end)));
        sum = hn::Add(sum, hn::IfThenElseZero(hn::FirstN(n, count - p), is_near));
    }
    return static_cast<std::uint16_t>(-hn::GetLane(hn::SumOfLanes(n, sum)));
}
#endif

/// The counts of up to 2^15 points.
HWY_INLINE void count_near(const Hypotheses& lines, std::size_t hypotheses, std::int16_t near,
                           const GridPoint* HWY_RESTRICT points, std::size_t count,
                           std::uint16_t* HWY_RESTRICT counts) {
    const std::size_t lanes = hn::Lanes(Shorts());
    std::size_t i = 0;
    while (hypotheses > i) {
        const std::size_t rest = hypotheses - i;
#if HWY_TARGET != HWY_SCALAR
        // A vector for a few lines would mostly count nothing.
        if (8 * rest <= lanes) {
            for (; i < hypotheses; ++i) counts[i] = count_points_near(lines, i, near, points, count);
            break;
        }
#endif
        if (rest > 2 * lanes + lanes / 8) {
            count_lanes_near<3>(lines, i, near, points, count, counts);
            i += 3 * lanes;
        } else if (rest > lanes + lanes / 8) {
            count_lanes_near<2>(lines, i, near, points, count, counts);
            i += 2 * lanes;
        } else {
            count_lanes_near<1>(lines, i, near, points, count, counts);
            i += lanes;
        }
    }
}

SupportBounds bound_support(const LineSamples& samples, std::int16_t near, const GridPoint* points,
                            std::size_t count, GridPoint* rounded, std::uint32_t* HWY_RESTRICT support) {
    constexpr std::size_t block = 32768;  // fits the counts
    const hn::CappedTag<std::uint32_t, room_behind_points> c;
    const hn::Rebind<std::uint16_t, decltype(c)> narrow;
    alignas(64) std::uint16_t counts[LineSamples::most];
    Hypotheses lines;
    lines_through(samples, lines);
    round_points(points, count, rounded);
    auto most = hn::Zero(c);
    for (std::size_t done = 0; done < count; done += block) {
        count_near(lines, samples.count, near, rounded + done, std::min(block, count - done), counts);
        for (std::size_t i = 0; i < samples.count; i += hn::Lanes(c)) {
            auto sum = hn::PromoteTo(c, hn::Load(narrow, counts + i));
            if (done > 0) sum = hn::Add(sum, hn::LoadU(c, support + i));
            sum = hn::IfThenElseZero(hn::FirstN(c, samples.count - i), sum);
            hn::StoreU(sum, c, support + i);
            most = hn::Max(most, sum);
        }
    }
    const auto largest = hn::MaxOfLanes(c, most);
    SupportBounds bounds{hn::GetLane(largest), 0};
    for (; bounds.first < samples.count; bounds.first += hn::Lanes(c)) {
        const auto found = hn::FindFirstTrue(c, hn::Eq(hn::LoadU(c, support + bounds.first), largest));
        if (found < 0) continue;
        bounds.first += static_cast<std::size_t>(found);
        break;
    }
    return bounds;
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(bound_support);

SupportBounds bound_support(const LineSamples& samples, std::int16_t near, const GridPoint* points,
                            std::size_t count, GridPoint* rounded, std::uint32_t* support) {
    return HWY_DYNAMIC_DISPATCH(bound_support)(samples, near, points, count, rounded, support);
}

}  // namespace goalmouth
#endif
