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

using Doubles = hn::CappedTag<double, room_behind_points / 2>;
using Floats = hn::CappedTag<float, room_behind_points>;
using Integers = hn::RebindToSigned<Floats>;
using Shorts = hn::CappedTag<std::int16_t, 2 * room_behind_points>;
using DoubleVector = hn::Vec<Doubles>;
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

HWY_INLINE void lines_through(const LineSamples& samples, Hypotheses& lines) {
    const Integers n;
    const Floats f;
    const hn::Rebind<std::int16_t, Integers> words;
    // Shorter than this the digits behind the point do not suffice for a direction.
    const auto least = hn::Set(f, shortest_sample * shortest_sample * 0x1p32F);
    // Less than 2^15 by the share that the approximate root may be wrong.
    const auto unit = hn::Set(f, 32500.0F);
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
        const auto normal_x = hn::NearestInt(hn::Mul(along_y, shorten));
        const auto normal_y = hn::NearestInt(hn::Neg(hn::Mul(along_x, shorten)));
        const auto along_normal = hn::MulAdd(hn::ConvertTo(f, normal_x), hn::ConvertTo(f, x),
                                             hn::Mul(hn::ConvertTo(f, normal_y), hn::ConvertTo(f, y)));
        const auto offset = hn::NearestInt(hn::Mul(along_normal, hn::Set(f, 0x1p-31F)));
        hn::StoreU(hn::DemoteTo(words, normal_x), words, lines.normal_x + i);
        hn::StoreU(hn::DemoteTo(words, normal_y), words, lines.normal_y + i);
        hn::StoreU(hn::DemoteTo(words, offset), words, lines.offset + i);
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

    HWY_INLINE LineLanes(const Hypotheses& lines, std::size_t i, std::int16_t near)
        : normal_x(hn::Load(Shorts(), lines.normal_x + i)),
          normal_y(hn::Load(Shorts(), lines.normal_y + i)),
          start(hn::Sub(hn::Load(Shorts(), lines.offset + i),
                        hn::Set(Shorts(), static_cast<std::int16_t>(near - 1 - 32768)))) {}

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

/// The counts of up to 2^15 points.
HWY_INLINE void count_near(const Hypotheses& lines, std::size_t hypotheses, std::int16_t near,
                           const GridPoint* HWY_RESTRICT points, std::size_t count,
                           std::uint16_t* HWY_RESTRICT counts) {
    const Shorts s;
    const std::size_t lanes = hn::Lanes(s);
    const auto end = hn::Set(s, static_cast<std::int16_t>(2 * near - 1 - 32768));
    const hn::RebindToUnsigned<Shorts> u;
    for (std::size_t i = 0; i < hypotheses; i += 2 * lanes) {
        const LineLanes a(lines, i, near);
        auto count_a = hn::Zero(s);
        if (i + lanes < hypotheses) {
            const LineLanes b(lines, i + lanes, near);
            auto count_b = hn::Zero(s);
            for (std::size_t p = 0; p < count; ++p) {
                const auto x = in_all_lanes(points[p].x);
                const auto y = in_all_lanes(points[p].y);
                count_a = count_lanes(a.is_near(x, y, end), count_a);
                count_b = count_lanes(b.is_near(x, y, end), count_b);
            }
            hn::Store(hn::BitCast(u, count_b), u, counts + i + lanes);
        } else {
            for (std::size_t p = 0; p < count; ++p)
                count_a = count_lanes(a.is_near(in_all_lanes(points[p].x), in_all_lanes(points[p].y), end),
                                      count_a);
        }
        hn::Store(hn::BitCast(u, count_a), u, counts + i);
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

/// Line::distance() < distance, operation by operation: no fused multiply-add, which rounds once less.
HWY_INLINE hn::Mask<Doubles> near_exactly(const Line& line, double distance, DoubleVector x, DoubleVector y) {
    const Doubles d;
    const auto along_normal =
        hn::Add(hn::Mul(hn::Set(d, line.normal.x()), x), hn::Mul(hn::Set(d, line.normal.y()), y));
    return hn::Lt(hn::Abs(hn::Sub(along_normal, hn::Set(d, line.offset))), hn::Set(d, distance));
}

std::size_t count_inliers(const double* x, const double* y, std::size_t count, const Line& line,
                          double distance) {
    const Doubles d;
    std::size_t inliers = 0;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto near = near_exactly(line, distance, hn::LoadU(d, x + i), hn::LoadU(d, y + i));
        inliers += hn::CountTrue(d, hn::And(near, hn::FirstN(d, count - i)));
    }
    return inliers;
}

std::size_t take_inliers(const PointTable& points, std::size_t count, const Line& line, double distance,
                         double* HWY_RESTRICT inlier_x, double* HWY_RESTRICT inlier_y) {
    const Doubles d;
    std::size_t taken = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto x = hn::LoadU(d, points.x + i);
        const auto y = hn::LoadU(d, points.y + i);
        const auto near = near_exactly(line, distance, x, y);
#if HWY_TARGET <= HWY_AVX3
        const hn::Rebind<std::uint64_t, Doubles> places;
        std::uint64_t* const grid = reinterpret_cast<std::uint64_t*>(points.grid);
        const auto place = hn::LoadU(places, grid + i);
        const auto inside = hn::FirstN(d, count - i);
        const auto far = hn::AndNot(near, inside);
        hn::CompressStore(x, hn::And(near, inside), d, inlier_x + taken);
        taken += hn::CompressStore(y, hn::And(near, inside), d, inlier_y + taken);
        hn::CompressStore(x, far, d, points.x + kept);
        hn::CompressStore(y, far, d, points.y + kept);
        kept += hn::CompressStore(place, hn::RebindMask(places, far), places, grid + kept);
#else
        std::uint8_t bits[8];  // as many as it may write; one has the lanes
        hn::StoreMaskBits(d, near, bits);
        std::size_t is_near = bits[0];
        const std::size_t behind = std::min(i + hn::Lanes(d), count);
        // To both places, but only one goes on: no branch that half of the points would take.
        for (std::size_t j = i; j < behind; ++j, is_near >>= 1) {
            points.x[kept] = inlier_x[taken] = points.x[j];
            points.y[kept] = inlier_y[taken] = points.y[j];
            points.grid[kept] = points.grid[j];
            taken += is_near & 1;
            kept += 1 - (is_near & 1);
        }
#endif
    }
    return taken;
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(bound_support);
HWY_EXPORT(count_inliers);
HWY_EXPORT(take_inliers);

SupportBounds bound_support(const LineSamples& samples, std::int16_t near, const GridPoint* points,
                            std::size_t count, GridPoint* rounded, std::uint32_t* support) {
    return HWY_DYNAMIC_DISPATCH(bound_support)(samples, near, points, count, rounded, support);
}

std::size_t count_inliers(const double* x, const double* y, std::size_t count, const Line& line,
                          double distance) {
    return HWY_DYNAMIC_DISPATCH(count_inliers)(x, y, count, line, distance);
}

std::size_t take_inliers(const PointTable& points, std::size_t count, const Line& line, double distance,
                         double* inlier_x, double* inlier_y) {
    return HWY_DYNAMIC_DISPATCH(take_inliers)(points, count, line, distance, inlier_x, inlier_y);
}

}  // namespace goalmouth
#endif
