#include "core/detection/line_scoring.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/detection/line_scoring.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, room_behind_points / 2>;
using Floats = hn::CappedTag<float, room_behind_points>;
using Counts = hn::RebindToUnsigned<Floats>;
using DoubleVector = hn::Vec<Doubles>;
using FloatVector = hn::Vec<Floats>;
using CountVector = hn::Vec<Counts>;

double coarse_points(const Eigen::Vector2d* points, std::size_t count, Eigen::Vector2f* coarse) {
    const Doubles d;
    const hn::Rebind<float, Doubles> f;
    const auto first_x = hn::Set(d, points[0].x());
    const auto first_y = hn::Set(d, points[0].y());
    auto reach = hn::Zero(d);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        DoubleVector x;
        DoubleVector y;
        hn::LoadInterleaved2(d, points[i].data(), x, y);
        const auto inside = hn::FirstN(d, count - i);
        x = hn::IfThenElseZero(inside, hn::Sub(x, first_x));
        y = hn::IfThenElseZero(inside, hn::Sub(y, first_y));
        reach = hn::Max(reach, hn::Max(hn::Abs(x), hn::Abs(y)));
        hn::StoreInterleaved2(hn::DemoteTo(f, x), hn::DemoteTo(f, y), f, coarse[i].data());
    }
    return hn::GetLane(hn::MaxOfLanes(d, reach));
}

/// Lines, one for each sample: normal · p = offset, with normals as long as their samples and with the square
/// of what distance × length allows. So no line needs a root or a division.
struct Hypotheses {
    alignas(64) float normal_x[LineSamples::most];
    alignas(64) float normal_y[LineSamples::most];
    alignas(64) float offset[LineSamples::most];
    alignas(64) float limit[LineSamples::most];
};

HWY_INLINE void lines_through(const LineSamples& samples, float distance, Hypotheses& lines) {
    const Floats d;
    const auto square = hn::Set(d, distance * distance);
    const auto least = hn::Set(d, 1e-30F);
    for (std::size_t i = 0; i < samples.count; i += hn::Lanes(d)) {
        FloatVector x;
        FloatVector y;
        FloatVector along_x;
        FloatVector along_y;
        hn::LoadInterleaved2(d, samples.point[i].data(), x, y);
        hn::LoadInterleaved2(d, samples.along[i].data(), along_x, along_y);
        const auto length = hn::MulAdd(along_x, along_x, hn::Mul(along_y, along_y));  // squared
        const auto limit = hn::Mul(length, square);
        // Too short for single precision: a line that every point lies on.
        const auto known = hn::And(hn::Ge(length, least), hn::Ge(limit, least));
        const auto normal_x = hn::IfThenElseZero(known, along_y);
        const auto normal_y = hn::IfThenElseZero(known, hn::Neg(along_x));
        hn::Store(normal_x, d, lines.normal_x + i);
        hn::Store(normal_y, d, lines.normal_y + i);
        hn::Store(hn::MulAdd(normal_x, x, hn::Mul(normal_y, y)), d, lines.offset + i);
        hn::Store(hn::IfThenElse(known, limit, hn::Set(d, 1.0F)), d, lines.limit + i);
    }
}

/// Which lanes' lines pass the point nearer than the limit.
HWY_INLINE hn::Mask<Floats> is_near(FloatVector normal_x, FloatVector normal_y, FloatVector offset,
                                    FloatVector limit, FloatVector x, FloatVector y) {
    const auto from = hn::MulAdd(normal_x, x, hn::MulSub(normal_y, y, offset));
    return hn::Lt(hn::Mul(from, from), limit);
}

/// `count` and one more in the lanes of the mask.
HWY_INLINE CountVector count_lanes(hn::Mask<Floats> mask, CountVector count) {
    const Counts c;
    const auto one_more = hn::RebindMask(c, mask);
#if HWY_TARGET <= HWY_AVX3
    return hn::IfThenElse(one_more, hn::Add(count, hn::Set(c, 1)), count);
#else
    return hn::Sub(count, hn::VecFromMask(c, one_more));
#endif
}

/// Of one line, with the points in the lanes.
HWY_INLINE std::uint32_t count_near(const Hypotheses& lines, std::size_t i,
                                    const Eigen::Vector2f* HWY_RESTRICT coarse, std::size_t points) {
    const Floats d;
    const auto normal_x = hn::Set(d, lines.normal_x[i]);
    const auto normal_y = hn::Set(d, lines.normal_y[i]);
    const auto offset = hn::Set(d, lines.offset[i]);
    const auto limit = hn::Set(d, lines.limit[i]);
    std::size_t count = 0;
    for (std::size_t p = 0; p < points; p += hn::Lanes(d)) {
        FloatVector x;
        FloatVector y;
        hn::LoadInterleaved2(d, coarse[p].data(), x, y);
        const auto near = is_near(normal_x, normal_y, offset, limit, x, y);
        count += hn::CountTrue(d, hn::And(near, hn::FirstN(d, points - p)));
    }
    return static_cast<std::uint32_t>(count);
}

std::uint32_t bound_support(const LineSamples& samples, const Eigen::Vector2f* HWY_RESTRICT coarse,
                            std::size_t points, float distance, std::uint32_t* HWY_RESTRICT support) {
    const Floats d;
    const Counts c;
    const std::size_t lanes = hn::Lanes(d);
    Hypotheses lines;
    lines_through(samples, distance, lines);
    auto most = hn::Zero(c);
    std::size_t i = 0;
    // Two vectors of hypotheses for each load of a point; what is left over by one, if it fills it somehow.
    const std::size_t few = lanes / 4;
    for (; i + lanes + few < samples.count; i += 2 * lanes) {
        const auto normal_x_a = hn::Load(d, lines.normal_x + i);
        const auto normal_y_a = hn::Load(d, lines.normal_y + i);
        const auto offset_a = hn::Load(d, lines.offset + i);
        const auto limit_a = hn::Load(d, lines.limit + i);
        const auto normal_x_b = hn::Load(d, lines.normal_x + i + lanes);
        const auto normal_y_b = hn::Load(d, lines.normal_y + i + lanes);
        const auto offset_b = hn::Load(d, lines.offset + i + lanes);
        const auto limit_b = hn::Load(d, lines.limit + i + lanes);
        auto count_a = hn::Zero(c);
        auto count_b = hn::Zero(c);
        for (std::size_t p = 0; p < points; ++p) {
            const auto x = hn::Set(d, coarse[p].x());
            const auto y = hn::Set(d, coarse[p].y());
            count_a = count_lanes(is_near(normal_x_a, normal_y_a, offset_a, limit_a, x, y), count_a);
            count_b = count_lanes(is_near(normal_x_b, normal_y_b, offset_b, limit_b, x, y), count_b);
        }
        hn::StoreU(count_a, c, support + i);
        hn::StoreU(count_b, c, support + i + lanes);
        count_b = hn::IfThenElseZero(hn::FirstN(c, samples.count - i - lanes), count_b);
        most = hn::Max(most, hn::Max(count_a, count_b));
    }
    if (i + few < samples.count) {
        const auto normal_x = hn::Load(d, lines.normal_x + i);
        const auto normal_y = hn::Load(d, lines.normal_y + i);
        const auto offset = hn::Load(d, lines.offset + i);
        const auto limit = hn::Load(d, lines.limit + i);
        auto count = hn::Zero(c);
        for (std::size_t p = 0; p < points; ++p) {
            const auto x = hn::Set(d, coarse[p].x());
            const auto y = hn::Set(d, coarse[p].y());
            count = count_lanes(is_near(normal_x, normal_y, offset, limit, x, y), count);
        }
        hn::StoreU(count, c, support + i);
        most = hn::Max(most, hn::IfThenElseZero(hn::FirstN(c, samples.count - i), count));
        i += lanes;
    }
    std::uint32_t largest = hn::GetLane(hn::MaxOfLanes(c, most));
    for (; i < samples.count; ++i) {
        support[i] = count_near(lines, i, coarse, points);
        largest = std::max(largest, support[i]);
    }
    return largest;
}

/// Line::distance() < distance, operation by operation: no fused multiply-add, which rounds once less.
HWY_INLINE hn::Mask<Doubles> near_exactly(const Line& line, double distance, DoubleVector x, DoubleVector y) {
    const Doubles d;
    const auto along_normal =
        hn::Add(hn::Mul(hn::Set(d, line.normal.x()), x), hn::Mul(hn::Set(d, line.normal.y()), y));
    return hn::Lt(hn::Abs(hn::Sub(along_normal, hn::Set(d, line.offset))), hn::Set(d, distance));
}

std::size_t count_inliers(const Eigen::Vector2d* points, std::size_t count, const Line& line,
                          double distance) {
    const Doubles d;
    std::size_t inliers = 0;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        DoubleVector x;
        DoubleVector y;
        hn::LoadInterleaved2(d, points[i].data(), x, y);
        inliers += hn::CountTrue(d, hn::And(near_exactly(line, distance, x, y), hn::FirstN(d, count - i)));
    }
    return inliers;
}

std::size_t take_inliers(Eigen::Vector2d* points, std::size_t count, const Line& line, double distance,
                         Eigen::Vector2d* inliers) {
    const Doubles d;
    std::size_t taken = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        DoubleVector x;
        DoubleVector y;
        hn::LoadInterleaved2(d, points[i].data(), x, y);
        std::uint8_t bits[8];  // as many as it may write; one has the lanes
        hn::StoreMaskBits(d, near_exactly(line, distance, x, y), bits);
        std::size_t near = bits[0];
        const std::size_t behind = std::min(i + hn::Lanes(d), count);
        // To both places, but only one goes on: no branch that half of the points would take.
        for (std::size_t j = i; j < behind; ++j, near >>= 1) {
            const Eigen::Vector2d point = points[j];
            inliers[taken] = point;
            points[kept] = point;
            taken += near & 1;
            kept += 1 - (near & 1);
        }
    }
    return taken;
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(coarse_points);
HWY_EXPORT(bound_support);
HWY_EXPORT(count_inliers);
HWY_EXPORT(take_inliers);

double coarse_points(const Eigen::Vector2d* points, std::size_t count, Eigen::Vector2f* coarse) {
    return HWY_DYNAMIC_DISPATCH(coarse_points)(points, count, coarse);
}

float coarse_distance(double distance, const Eigen::Vector2d& first, double reach) {
    constexpr double farthest = 1e8;  // px; its fourth power is still a float
    if (!(reach < farthest)) return std::numeric_limits<float>::infinity();
    // At most some 30 roundings of coordinates of either kind, coarse ones and Line's own, and 8 of the
    // distance.
    const double error = 0x1p-18 * reach + 0x1p-47 * (first.cwiseAbs().maxCoeff() + reach);
    const double enough = (distance + error) * (1.0 + 0x1p-20);
    // Beyond this nothing is: no distance is as large as the coordinates' sum.
    return static_cast<float>(std::min(enough, 4.0 * farthest));
}

std::uint32_t bound_support(const LineSamples& samples, const Eigen::Vector2f* coarse, std::size_t count,
                            float distance, std::uint32_t* support) {
    return HWY_DYNAMIC_DISPATCH(bound_support)(samples, coarse, count, distance, support);
}

std::size_t count_inliers(const Eigen::Vector2d* points, std::size_t count, const Line& line,
                          double distance) {
    return HWY_DYNAMIC_DISPATCH(count_inliers)(points, count, line, distance);
}

std::size_t take_inliers(Eigen::Vector2d* points, std::size_t count, const Line& line, double distance,
                         Eigen::Vector2d* inliers) {
    return HWY_DYNAMIC_DISPATCH(take_inliers)(points, count, line, distance, inliers);
}

}  // namespace goalmouth
#endif
