#include "core/detection/point_grid.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/detection/point_grid.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, room_behind_points / 2>;
using DoubleVector = hn::Vec<Doubles>;

Box split_points(std::span<const Eigen::Vector2d> points, double* HWY_RESTRICT to_x,
                 double* HWY_RESTRICT to_y) {
    if (points.empty()) return {};
    const Doubles d;
    auto least_x = hn::Set(d, points[0].x());
    auto least_y = hn::Set(d, points[0].y());
    auto greatest_x = least_x;
    auto greatest_y = least_y;
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= points.size(); i += hn::Lanes(d)) {
        DoubleVector x;
        DoubleVector y;
        hn::LoadInterleaved2(d, points[i].data(), x, y);
        hn::StoreU(x, d, to_x + i);
        hn::StoreU(y, d, to_y + i);
        least_x = hn::Min(least_x, x);
        least_y = hn::Min(least_y, y);
        greatest_x = hn::Max(greatest_x, x);
        greatest_y = hn::Max(greatest_y, y);
    }
    Box box{{hn::GetLane(hn::MinOfLanes(d, least_x)), hn::GetLane(hn::MinOfLanes(d, least_y))},
            {hn::GetLane(hn::MaxOfLanes(d, greatest_x)), hn::GetLane(hn::MaxOfLanes(d, greatest_y))}};
    for (; i < points.size(); ++i) {
        to_x[i] = points[i].x();
        to_y[i] = points[i].y();
        box.least = box.least.cwiseMin(points[i]);
        box.greatest = box.greatest.cwiseMax(points[i]);
    }
    return box;
}

void place_on_grid(const Grid& grid, const double* HWY_RESTRICT x, const double* HWY_RESTRICT y,
                   std::size_t count, GridPoint* HWY_RESTRICT points) {
    const Doubles d;
    const hn::Rebind<std::int32_t, Doubles> whole;
    const auto middle_x = hn::Set(d, grid.middle.x());
    const auto middle_y = hn::Set(d, grid.middle.y());
    const auto scale = hn::Set(d, 0x1p16 * grid.scale);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto a = hn::Mul(hn::Sub(hn::LoadU(d, x + i), middle_x), scale);
        const auto b = hn::Mul(hn::Sub(hn::LoadU(d, y + i), middle_y), scale);
        hn::StoreInterleaved2(hn::DemoteTo(whole, a), hn::DemoteTo(whole, b), whole, &points[i].x);
    }
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(split_points);
HWY_EXPORT(place_on_grid);

Box split_points(std::span<const Eigen::Vector2d> points, double* x, double* y) {
    return HWY_DYNAMIC_DISPATCH(split_points)(points, x, y);
}

Grid grid_for(const Box& box, double distance) {
    constexpr double farthest = 10000.0;  // with which no sum of what a line and a point need overflows
    constexpr double nearest = 4000.0;    // the same for `near`
    Grid grid;
    grid.middle = 0.5 * box.least + 0.5 * box.greatest;
    const double reach = 0.5 * (box.greatest - box.least).maxCoeff();
    if (!(reach < 1e100)) return grid;
    const double magnitude = box.least.cwiseAbs().cwiseMax(box.greatest.cwiseAbs()).maxCoeff();
    // Roundings of Line's own and of single precision.
    const double enough = distance + 0x1p-18 * reach + 0x1p-47 * magnitude;
    if (!(enough > 1e-100 && enough < 1e100)) return grid;
    grid.scale = std::min(farthest / reach, nearest / enough);
    // Roundings to whole numbers: those of the point (0.71) and of the normal (0.62), of two products (1) and
    // of the offset (0.51), and of the shortest sample's direction (0.31).
    grid.near = static_cast<std::int16_t>(enough * grid.scale + 3.4) + 1;
    return grid;
}

void place_on_grid(const Grid& grid, const double* x, const double* y, std::size_t count, GridPoint* points) {
    HWY_DYNAMIC_DISPATCH(place_on_grid)(grid, x, y, count, points);
}

}  // namespace goalmouth
#endif
