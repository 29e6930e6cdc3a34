#pragma once

#include "core/geometry/cylinder.h"
#include "core/simulation/coverage.h"
#include "core/simulation/ground_grid.h"
#include "core/simulation/light.h"
#include "core/simulation/scene.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Shadow of a cylinder or ball on the ground under lamps that are far away. A cylinder is the hull of its
/// two end discs, so its shadow is the hull of two equal ellipses: two half ellipses and between them a strip
/// that is r / |horizontal part of unit(a×l)| wide to either side, for an axis a and lamps towards l. A map
/// of the plane that makes the ellipses unit circles makes it all points within 1 of a segment. The shadow of
/// a ball is one ellipse with semi-axes r and r / sin(elevation).
class Shadow {
  public:
    Shadow(const Cylinder& cylinder, const Light& light);
    Shadow(const Ball& ball, const Light& light);

    /// Share of the lamps' light that a pixel of the ground loses, 0…1. Its edge is a ramp as wide as the
    /// lamps' image through the casting point: lamp size × distance, longer where the light falls flat.
    float share(const Footprint& p) const {
        const float px = p.x - x_;
        const float py = p.y - y_;
        const float vx = axx_ * px + axy_ * py;
        const float vy = ayx_ * px + ayy_ * py;
        const float along = vx * run_x_ + vy * run_y_;
        const float nearest = std::min(std::max(along, 0.0F), run_);
        const float ex = vx - nearest * run_x_;
        const float ey = vy - nearest * run_y_;
        const float square = ex * ex + ey * ey;
        // Most pixels are clear of the edge, whichever way it runs.
        const float edge = widest_ * (std::abs(p.xu) + std::abs(p.yu) + std::abs(p.xv) + std::abs(p.yv)) +
                           blur_reach_ + blur_reach_change_ * nearest;
        if (square >= (1.0F + edge) * (1.0F + edge)) return 0.0F;
        if (edge < 1.0F && square <= (1.0F - edge) * (1.0F - edge)) return 1.0F;
        return share_at_edge(p, vx, vy, along, nearest);
    }

    /// Within this distance [m] of the segment from…to is all of it, penumbra included.
    double reach() const { return reach_; }
    const Eigen::Vector2d& from() const { return from_; }
    const Eigen::Vector2d& to() const { return to_; }

  private:
    Shadow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& disc_normal,
           double radius, const Light& light);

    float share_at_edge(const Footprint& p, float vx, float vy, float along, float nearest) const;

    Eigen::Vector2d from_, to_;  // of the axis' shadow, m
    double reach_;
    float x_, y_;                  // from_
    float axx_, axy_, ayx_, ayy_;  // the map
    float run_x_, run_y_;          // unit direction of the segment, mapped
    float run_;                    // its length, mapped
    float blur_, blur_change_;     // m: width of the ramp across the light at from_, and from there to to_
    float flat_x_, flat_y_;        // where the light falls along, times cot(elevation)
    // Mapped, at most: half of what is 1 m across, half the ramp at from_, and how that changes on the way.
    float widest_, blur_reach_, blur_reach_change_;
};

/// Shadows of goals, robots and ball on the ground, with a map of where they are. Things beyond the carpet
/// (people, poles) cast none, and no shadow falls on anything but the ground.
class ShadowMap {
  public:
    /// No shadow.
    ShadowMap() = default;
    /// Empty where the light has no shadows, or lamps lower than 3°.
    ShadowMap(const Scene& scene, const Light& light);

    bool empty() const { return shadows_.empty(); }

    /// For a row of ground points: where each looks in the map of the smallest pixels.
    void find_cells(const float* x, const float* y, int count, int* cells) const;
    /// First of the list of shadows that a pixel within `radius` [m] of a ground point can touch, as first();
    /// `cell` from find_cells().
    int first_in(int cell, float x, float y, float radius) const {
        const Level& level = levels_.front();
        return radius < level.reach ? level.heads[static_cast<std::size_t>(cell)] : first(x, y, radius);
    }
    /// First of the list of shadows that a pixel within `radius` [m] of a ground point can touch; none: −1.
    int first(float x, float y, float radius) const {
        for (const Level& level : levels_)
            if (radius < level.reach) return level.heads[static_cast<std::size_t>(level.grid.cell(x, y))];
        return -1;  // a pixel of metres: at the horizon
    }
    /// Share of the lamps' light that a pixel loses to the shadows of a list. Where several fall, the deepest
    /// counts.
    float share(int first, const Footprint& p) const {
        float share = 0.0F;
        for (int i = first; i >= 0 && share < 1.0F; i = entries_[static_cast<std::size_t>(i)].next)
            share = std::max(share, shadows_[entries_[static_cast<std::size_t>(i)].shadow].share(p));
        return share;
    }

  private:
    struct Level {
        float reach;
        GroundGrid grid;                  // its rim is empty
        std::vector<std::int32_t> heads;  // of each cell's list in entries_
    };
    struct Entry {
        std::uint32_t shadow;
        std::int32_t next;
    };

    void add_level(double cell, double reach, const FieldLayout& layout);

    std::vector<Shadow> shadows_;
    std::vector<Level> levels_;  // from small pixels to large
    std::vector<Entry> entries_;
};

}  // namespace goalmouth
