#include "core/detection/line_inliers.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/detection/line_inliers.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, room_behind_points / 2>;
using DoubleVector = hn::Vec<Doubles>;

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

#if HWY_TARGET <= HWY_AVX3
template <class D>
HWY_INLINE void store_chosen(hn::Vec<D> v, hn::Mask<D> chosen, std::size_t, D d, hn::TFromD<D>* to) {
    hn::CompressStore(v, chosen, d, to);
}
#elif HWY_TARGET == HWY_AVX2
/// For each choice of four lanes where the chosen ones stand, in halves.
struct LanesToFront {
    alignas(32) std::uint32_t halves[16][8] = {};

    constexpr LanesToFront() {
        for (std::uint32_t chosen = 0; chosen < 16; ++chosen) {
            std::size_t i = 0;
            for (std::uint32_t lane = 0; lane < 4; ++lane) {
                if ((chosen >> lane & 1) == 0) continue;
                halves[chosen][i++] = 2 * lane;
                halves[chosen][i++] = 2 * lane + 1;
            }
        }
    }
};
constexpr LanesToFront lanes_to_front;

/// Highway's own would copy its table to the stack for each vector.
template <class D>
HWY_INLINE void store_chosen(hn::Vec<D> v, hn::Mask<D>, std::size_t bits, D d, hn::TFromD<D>* to) {
    const hn::Repartition<std::uint32_t, D> halves;
    const auto front = hn::SetTableIndices(halves, lanes_to_front.halves[bits]);
    hn::StoreU(hn::BitCast(d, hn::TableLookupLanes(hn::BitCast(halves, v), front)), d, to);
}
#endif

std::size_t take_inliers(const PointTable& points, std::size_t count, const Line& line, double distance,
                         double* HWY_RESTRICT inlier_x, double* HWY_RESTRICT inlier_y) {
    const Doubles d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t taken = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; i += lanes) {
        const auto x = hn::LoadU(d, points.x + i);
        const auto y = hn::LoadU(d, points.y + i);
        const auto near = near_exactly(line, distance, x, y);
        std::uint8_t mask[8];  // as many as it may write; one has the lanes
        hn::StoreMaskBits(d, near, mask);
        const std::size_t all = (std::size_t{1} << std::min(lanes, count - i)) - 1;
        std::size_t is_near = mask[0] & all;
#if HWY_TARGET <= HWY_AVX2
        const hn::Rebind<std::uint64_t, Doubles> places;
        std::uint64_t* const grid = reinterpret_cast<std::uint64_t*>(points.grid);
        const auto place = hn::LoadU(places, grid + i);
        const auto far = hn::Not(near);
        store_chosen(x, near, is_near, d, inlier_x + taken);
        store_chosen(y, near, is_near, d, inlier_y + taken);
        store_chosen(x, far, is_near ^ all, d, points.x + kept);
        store_chosen(y, far, is_near ^ all, d, points.y + kept);
        store_chosen(place, hn::RebindMask(places, far), is_near ^ all, places, grid + kept);
        const std::size_t more = hwy::PopCount(is_near);
        taken += more;
        kept += std::min(lanes, count - i) - more;
#else
        // To both places, but only one goes on: no branch that half of the points would take.
        for (std::size_t j = i; j < std::min(i + lanes, count); ++j, is_near >>= 1) {
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

HWY_EXPORT(count_inliers);
HWY_EXPORT(take_inliers);

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
