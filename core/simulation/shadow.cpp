#include "core/simulation/shadow.h"

#include "core/geometry/segment.h"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace goalmouth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double lowest_lamps = 0.0523;      // sine of 3°: shadows twenty times as long as things are high
constexpr double thinnest_ellipse = 0.0005;  // m: an ellipse seen edge on cannot be made a circle
constexpr double beyond_carpet = 3.0;        // m: where shadows are left out

Vector2d cast(const Vector3d& point, const Vector3d& lamps) {
    return point.head<2>() - point.z() / lamps.z() * lamps.head<2>();
}

}  // namespace

Shadow::Shadow(const Cylinder& cylinder, const Light& light)
    : Shadow(cylinder.base, cylinder.top(), cylinder.axis, cylinder.radius, light) {}

Shadow::Shadow(const Ball& ball, const Light& light)
    : Shadow(ball.centre, ball.centre, light.lamps(), ball.radius, light) {}

Shadow::Shadow(const Vector3d& from, const Vector3d& to, const Vector3d& disc_normal, double radius,
               const Light& light)
    : from_(cast(from, light.lamps())), to_(cast(to, light.lamps())) {
    const Vector3d& lamps = light.lamps();
    const Vector3d one = disc_normal.unitOrthogonal();
    Eigen::Matrix2d ellipse;
    ellipse << radius * cast(one, lamps), radius * cast(disc_normal.cross(one), lamps);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
    axes.computeDirect(ellipse * ellipse.transpose());
    const Vector2d half = axes.eigenvalues().cwiseMax(thinnest_ellipse * thinnest_ellipse).cwiseSqrt();
    const Eigen::Matrix2d map = half.cwiseInverse().asDiagonal() * axes.eigenvectors().transpose();

    Vector2d run = map * (to_ - from_);
    const double length = run.norm();
    run = length > 0.0 ? Vector2d(run / length) : Vector2d(1.0, 0.0);
    x_ = static_cast<float>(from_.x());
    y_ = static_cast<float>(from_.y());
    axx_ = static_cast<float>(map(0, 0));
    axy_ = static_cast<float>(map(0, 1));
    ayx_ = static_cast<float>(map(1, 0));
    ayy_ = static_cast<float>(map(1, 1));
    run_x_ = static_cast<float>(run.x());
    run_y_ = static_cast<float>(run.y());
    run_ = static_cast<float>(length);

    const auto blur = [&](const Vector3d& p) { return light.lamp_size() * std::max(0.0, p.z()) / lamps.z(); };
    blur_ = static_cast<float>(blur(from));
    blur_change_ = static_cast<float>(blur(to) - blur(from));
    const Vector2d flat = lamps.head<2>() / lamps.z();
    flat_x_ = static_cast<float>(flat.x());
    flat_y_ = static_cast<float>(flat.y());
    const double thinnest = half.minCoeff();
    // A ramp is longest across an edge that the light falls square to, on the ellipse's thin side.
    const double blur_reach = 0.5 / (lamps.z() * thinnest);
    widest_ = static_cast<float>(0.5 / thinnest);
    blur_reach_ = static_cast<float>(blur_reach * blur(from));
    blur_reach_change_ =
        static_cast<float>(length > 0.0 ? blur_reach * (blur(to) - blur(from)) / length : 0.0);
    reach_ = half.maxCoeff() + 0.5 * std::max(blur(from), blur(to)) / lamps.z();
}

float Shadow::share_at_edge(const Footprint& p, float vx, float vy, float along, float nearest) const {
    const float ex = vx - nearest * run_x_;
    const float ey = vy - nearest * run_y_;
    const float away = std::sqrt(ex * ex + ey * ey);
    const float blur = blur_ + (run_ > 0.0F ? blur_change_ * nearest / run_ : 0.0F);
    // How the mapped point moves from pixel to pixel.
    const float ux = axx_ * p.xu + axy_ * p.yu, uy = ayx_ * p.xu + ayy_ * p.yu;
    const float wx = axx_ * p.xv + axy_ * p.yv, wy = ayx_ * p.xv + ayy_ * p.yv;

    // Share between two parallel edges across the mapped unit direction (x, y), that far from the point.
    const auto between = [&](float x, float y, float before, float behind) {
        const float gx = axx_ * x + ayx_ * y;
        const float gy = axy_ * x + ayy_ * y;
        const float lean = gx * flat_x_ + gy * flat_y_;
        const float width = blur > 0.0F ? blur * std::sqrt(gx * gx + gy * gy + lean * lean) : 0.0F;
        const EdgeCoverage edge(x * ux + y * uy, x * wx + y * wy);
        return strip_coverage(edge.ramp(before, width), edge.ramp(behind, width));
    };
    const bool centred = away < 1e-4F;
    const float x = centred ? -run_y_ : ex / away;
    const float y = centred ? run_x_ : ey / away;
    const float straight = between(x, y, 1.0F - away, 1.0F + away + run_ * std::abs(x * run_x_ + y * run_y_));
    if (straight <= 0.0F || straight >= 1.0F) return straight;
    // A pixel larger than the shadow reaches beyond it also the other way. To such a pixel the rounded ends
    // are square ones that are as much shorter as keeps the area.
    const float across = vy * run_x_ - vx * run_y_;
    const float pixel = 0.5F * (std::abs(ux) + std::abs(uy) + std::abs(wx) + std::abs(wy));
    const float end = 1.0F - 0.2146F * std::clamp(pixel - 0.5F, 0.0F, 1.0F);  // 1 − π/4
    return std::min(straight, between(-run_y_, run_x_, 1.0F - across, 1.0F + across) *
                                  between(run_x_, run_y_, end + along, end + run_ - along));
}

ShadowMap::ShadowMap(const Scene& scene, const Light& light) {
    if (!light.shadows() || light.lamps().z() < lowest_lamps || light.lamps_share_on_ground() <= 0.0) return;
    for (const Tube& tube : scene.tubes)
        if (tube.of != Tube::Of::hall) shadows_.emplace_back(tube.cylinder, light);
    shadows_.emplace_back(scene.ball, light);
    add_level(0.05, 0.05, scene.layout);
    add_level(0.2, 0.4, scene.layout);
    add_level(1.0, 2.0, scene.layout);
}

void ShadowMap::find_cells(const float* x, const float* y, int count, int* cells) const {
    const GroundGrid grid = levels_.front().grid;
    for (int i = 0; i < count; ++i) cells[i] = grid.cell(x[i], y[i]);
}

void ShadowMap::add_level(double cell, double reach, const FieldLayout& layout) {
    // One more cell all around stays empty.
    const double half_x = layout.carpet_half_length + beyond_carpet;
    const double half_y = layout.carpet_half_width + beyond_carpet;
    const double left = -half_x - cell;
    const double bottom = -half_y - cell;
    Level level;
    level.reach = static_cast<float>(reach);
    GroundGrid& grid = level.grid;
    grid.inverse_cell = static_cast<float>(1.0 / cell);
    grid.origin_x = static_cast<float>(left);
    grid.origin_y = static_cast<float>(bottom);
    grid.width = static_cast<int>(std::ceil(2.0 * half_x / cell)) + 2;
    grid.height = static_cast<int>(std::ceil(2.0 * half_y / cell)) + 2;
    level.heads.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), -1);
    const auto index = [&](double at, double origin, int count) {
        return std::clamp(static_cast<int>(std::floor((at - origin) / cell)), 1, count - 2);
    };
    for (std::size_t i = 0; i < shadows_.size(); ++i) {
        const Shadow& s = shadows_[i];
        const double limit = s.reach() + reach + cell * std::sqrt(0.5);
        const Vector2d low = s.from().cwiseMin(s.to()).array() - limit;
        const Vector2d high = s.from().cwiseMax(s.to()).array() + limit;
        for (int cy = index(low.y(), bottom, grid.height); cy <= index(high.y(), bottom, grid.height); ++cy)
            for (int cx = index(low.x(), left, grid.width); cx <= index(high.x(), left, grid.width); ++cx) {
                const Vector2d middle(left + (cx + 0.5) * cell, bottom + (cy + 0.5) * cell);
                if (distance_to_segment<2>(s.from(), s.to(), middle) > limit) continue;
                std::int32_t& head =
                    level.heads[static_cast<std::size_t>(cy) * static_cast<std::size_t>(grid.width) +
                                static_cast<std::size_t>(cx)];
                entries_.push_back({static_cast<std::uint32_t>(i), head});
                head = static_cast<std::int32_t>(entries_.size()) - 1;
            }
    }
    levels_.push_back(std::move(level));
}

}  // namespace goalmouth
