#include "core/simulation/ground.h"

#include "core/random/random.h"
#include "core/simulation/coverage.h"
#include "core/simulation/vectorised.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace goalmouth {
namespace {

constexpr std::uint32_t carpet_edge_bit = 1U << 31U;
constexpr std::uint32_t outside_bit =
    1U << 30U;  // the cell lies beyond the carpet, further than the map's reach
constexpr std::size_t most_parts = 30;

constexpr int tile = 256;  // cells; a power of two
constexpr float tile_cells_per_m = 250.0F;
constexpr float tile_spot = 0.012F;     // m: what is smaller than this, the mottle shows in full
constexpr float mottle_levels = 32.0F;  // of the tile's bytes for one σ
constexpr float farthest = 200.0F;      // m along the optical axis

/// Brightness of the carpet from spot to spot: white noise smoothed over a few cells, wrapping around. In
/// bytes, for all of it to stay in the cache.
std::vector<std::int8_t> make_mottle() {
    Random random(0xca49e7ULL);
    const auto size = static_cast<std::size_t>(tile) * tile;
    std::vector<float> noise(size);
    for (float& n : noise) n = static_cast<float>(random.normal());
    constexpr int spread = 2;
    for (int pass = 0; pass < 2; ++pass)
        for (const bool across : {true, false}) {
            std::vector<float> smooth(size);
            for (int y = 0; y < tile; ++y)
                for (int x = 0; x < tile; ++x) {
                    float sum = 0.0F;
                    for (int k = -spread; k <= spread; ++k) {
                        const int sx = across ? (x + k) & (tile - 1) : x;
                        const int sy = across ? y : (y + k) & (tile - 1);
                        sum += noise[static_cast<std::size_t>(sy) * tile + static_cast<std::size_t>(sx)];
                    }
                    smooth[static_cast<std::size_t>(y) * tile + static_cast<std::size_t>(x)] = sum;
                }
            noise.swap(smooth);
        }
    double squares = 0.0;
    for (const float n : noise) squares += static_cast<double>(n) * static_cast<double>(n);
    const auto scale = static_cast<float>(1.0 / std::sqrt(squares / static_cast<double>(size)));
    std::vector<std::int8_t> levels;
    for (const float n : noise)
        levels.push_back(static_cast<std::int8_t>(std::clamp(mottle_levels * scale * n, -127.0F, 127.0F)));
    return levels;
}

}  // namespace

GroundPainter::GroundPainter(const Scene& scene, const Light& light, const Intrinsics& camera)
    : layout_(scene.layout) {
    if (layout_.strokes.size() + layout_.rings.size() > most_parts)
        throw std::invalid_argument("more than 30 lines on a field");
    for (const Stroke& s : layout_.strokes) {
        const Eigen::Vector2d middle = 0.5 * (s.from + s.to);
        const Eigen::Vector2d run = s.to - s.from;
        const Eigen::Vector2d along = run.normalized();
        strokes_.push_back({static_cast<float>(middle.x()), static_cast<float>(middle.y()),
                            static_cast<float>(along.x()), static_cast<float>(along.y()),
                            static_cast<float>(run.norm() / 2.0), static_cast<float>(s.width / 2.0)});
    }
    fine_ = make_map(0.025, 0.04);
    coarse_ = make_map(0.1, 0.4);
    mottle_ = make_mottle();
    pixel_u_ = static_cast<float>(1.0 / camera.fx);
    pixel_v_ = static_cast<float>(1.0 / camera.fy);
    const auto width = static_cast<std::size_t>(camera.width);
    depth_.resize(width);
    x_.resize(width);
    y_.resize(width);
    radius_.resize(width);
    cell_.resize(width);
    spot_.resize(width);
    shade_.resize(width);
    change_scene(scene, light);
}

void GroundPainter::change_scene(const Scene& scene, const Light& light) {
    const auto lit = static_cast<float>(light.flat(Eigen::Vector3d::UnitZ()));
    carpet_ = lit * scene.carpet;
    line_ = lit * scene.line;
    floor_ = lit * scene.floor;
    ceiling_ = scene.ceiling;
    mottle_scale_ = static_cast<float>(scene.mottle / mottle_levels);
    shadows_ = ShadowMap(scene, light);
    lamps_share_ = static_cast<float>(light.lamps_share_on_ground());
}

GroundPainter::Map GroundPainter::make_map(double cell, double reach) const {
    Map map;
    const double margin = reach + 3.0 * cell;
    const double left = -layout_.carpet_half_length - margin;
    const double bottom = -layout_.carpet_half_width - margin;
    map.reach = reach;
    GroundGrid& grid = map.grid;
    grid.inverse_cell = static_cast<float>(1.0 / cell);
    grid.width = static_cast<int>(std::ceil(-2.0 * left / cell));
    grid.height = static_cast<int>(std::ceil(-2.0 * bottom / cell));
    grid.origin_x = static_cast<float>(left);
    grid.origin_y = static_cast<float>(bottom);
    map.near.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
    const double limit = reach + cell * std::sqrt(0.5);
    std::size_t i = 0;
    for (int cy = 0; cy < grid.height; ++cy)
        for (int cx = 0; cx < grid.width; ++cx, ++i) {
            const Eigen::Vector2d p(left + (cx + 0.5) * cell, bottom + (cy + 0.5) * cell);
            std::uint32_t bits = 0;
            std::uint32_t bit = 1;
            for (const Stroke& s : layout_.strokes) {
                if (distance_to(s, p) <= limit) bits |= bit;
                bit <<= 1U;
            }
            for (const Ring& r : layout_.rings) {
                if (distance_to(r, p) <= limit) bits |= bit;
                bit <<= 1U;
            }
            const double out_x = std::abs(p.x()) - layout_.carpet_half_length;
            const double out_y = std::abs(p.y()) - layout_.carpet_half_width;
            const double out = std::max(out_x, out_y);
            if (out > limit)
                bits |= outside_bit;
            else if (out >= -limit)
                bits |= carpet_edge_bit;
            map.near[i] = bits;
        }
    return map;
}

void GroundPainter::look(const Eigen::Isometry3d& T_WC) {
    R_WC_ = T_WC.linear().cast<float>();
    position_ = T_WC.translation().cast<float>();
}

Footprint GroundPainter::footprint(float x, float y, float depth) const {
    // Derivative of position + depth(d)·R·d on the plane.
    const Eigen::Matrix3f& R = R_WC_;
    const float sx = (x - position_.x()) / position_.z();
    const float sy = (y - position_.y()) / position_.z();
    const float tu = depth * pixel_u_;
    const float tv = depth * pixel_v_;
    return {x,
            y,
            tu * (R(0, 0) + R(2, 0) * sx),
            tu * (R(1, 0) + R(2, 0) * sy),
            tv * (R(0, 1) + R(2, 1) * sx),
            tv * (R(1, 1) + R(2, 1) * sy)};
}

float GroundPainter::stroke_share(const FlatStroke& s, const Footprint& p) const {
    const float px = p.x - s.x;
    const float py = p.y - s.y;
    const float across = s.dx * py - s.dy * px;
    const EdgeCoverage side(s.dx * p.yu - s.dy * p.xu, s.dx * p.yv - s.dy * p.xv);
    if (std::abs(across) >= s.half_width + side.reach()) return 0.0F;
    const float along = s.dx * px + s.dy * py;
    const EdgeCoverage end(s.dx * p.xu + s.dy * p.yu, s.dx * p.xv + s.dy * p.yv);
    return strip_coverage(side(s.half_width - across), side(s.half_width + across)) *
           strip_coverage(end(s.half_length - along), end(s.half_length + along));
}

float GroundPainter::ring_share(const Ring& ring, const Footprint& p) const {
    const float px = p.x - static_cast<float>(ring.centre.x());
    const float py = p.y - static_cast<float>(ring.centre.y());
    const float r = std::sqrt(px * px + py * py);
    if (r <= 0.0F) return 0.0F;
    const float ux = px / r;
    const float uy = py / r;
    const float out = r - static_cast<float>(ring.radius);
    const auto half = static_cast<float>(ring.width / 2.0);
    const EdgeCoverage edge(ux * p.xu + uy * p.yu, ux * p.xv + uy * p.yv);
    if (std::abs(out) >= half + edge.reach()) return 0.0F;
    return strip_coverage(edge(half - out), edge(half + out));
}

float GroundPainter::line_share(std::uint32_t near, const Footprint& p) const {
    float bare = 1.0F;
    while (near != 0) {
        const auto part = static_cast<std::size_t>(std::countr_zero(near));
        near &= near - 1;
        bare *= 1.0F - (part < strokes_.size() ? stroke_share(strokes_[part], p)
                                               : ring_share(layout_.rings[part - strokes_.size()], p));
    }
    return 1.0F - bare;
}

float GroundPainter::carpet_share(const Footprint& p) const {
    const auto hx = static_cast<float>(layout_.carpet_half_length);
    const auto hy = static_cast<float>(layout_.carpet_half_width);
    const EdgeCoverage ends(p.xu, p.xv);
    const EdgeCoverage sides(p.yu, p.yv);
    return strip_coverage(ends(hx - p.x), ends(hx + p.x)) * strip_coverage(sides(hy - p.y), sides(hy + p.y));
}

GOALMOUTH_VECTORISED void GroundPainter::paint(const RowRays& rays, const LightRow& out) {
    const float* nx = rays.x;
    const float* ny = rays.y;
    const int width = out.width;
    const Eigen::Matrix3f& R = R_WC_;
    const float r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2);
    const float r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2);
    const float r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2);
    const float px = position_.x(), py = position_.y(), h = position_.z();
    const float pixel_u = pixel_u_, pixel_v = pixel_v_;
    const float pixel = std::max(pixel_u, pixel_v);
    const float steepness = 1.5F / h;
    float* depth = depth_.data();
    float* gx = x_.data();
    float* gy = y_.data();
    float* radius = radius_.data();
    int* cell = cell_.data();
    int* spot = spot_.data();
    const Map& fine = fine_;
    const GroundGrid grid = fine.grid;
    int hits = 0;
    for (int u = 0; u < width; ++u) {
        const float dz = r20 * nx[u] + r21 * ny[u] + r22;
        const float way = -h / dz;
        const float t = way < farthest ? way : farthest;
        const bool hit = dz < -1e-6F;
        const float s = hit ? t : 0.0F;
        depth[u] = s;
        radius[u] =
            pixel * s * (1.0F + s * steepness);  // no pixel's footprint reaches farther from its centre
        hits += hit ? 1 : 0;
    }
    if (hits == 0) {
        std::fill(out.r, out.r + width, ceiling_.r);
        std::fill(out.g, out.g + width, ceiling_.g);
        std::fill(out.b, out.b + width, ceiling_.b);
        return;
    }
    for (int u = 0; u < width; ++u) {
        const float s = depth[u];
        gx[u] = px + s * (r00 * nx[u] + r01 * ny[u] + r02);
        gy[u] = py + s * (r10 * nx[u] + r11 * ny[u] + r12);
    }
    for (int u = 0; u < width; ++u) {
        cell[u] = grid.cell(gx[u], gy[u]);
        const int tx = static_cast<int>(gx[u] * tile_cells_per_m) & (tile - 1);
        const int ty = static_cast<int>(gy[u] * tile_cells_per_m) & (tile - 1);
        spot[u] = ty * tile + tx;
    }
    // As if all were carpet; then what is not.
    float* shade = shade_.data();
    const std::int8_t* mottle = mottle_.data();
    const float mottle_scale = mottle_scale_;
    const Rgb carpet = carpet_;
    float* red = out.r;
    float* green = out.g;
    float* blue = out.b;
    for (int u = 0; u < width; ++u) shade[u] = static_cast<float>(mottle[spot[u]]);
    for (int u = 0; u < width; ++u) {
        const float r = radius[u] > tile_spot ? radius[u] : tile_spot;
        shade[u] = 1.0F + mottle_scale * shade[u] * (tile_spot / r);
    }
    for (int u = 0; u < width; ++u) red[u] = carpet.r * shade[u];
    for (int u = 0; u < width; ++u) green[u] = carpet.g * shade[u];
    for (int u = 0; u < width; ++u) blue[u] = carpet.b * shade[u];

    const auto parts = layout_.strokes.size() + layout_.rings.size();
    const std::uint32_t every_part = ((1U << parts) - 1U) | carpet_edge_bit;
    const auto carpet_x = static_cast<float>(layout_.carpet_half_length);
    const auto carpet_y = static_cast<float>(layout_.carpet_half_width);
    const auto fine_reach = static_cast<float>(fine_.reach);
    const auto coarse_reach = static_cast<float>(coarse_.reach);
    for (int u = 0; u < width; ++u) {
        const float t = depth[u];
        if (!(t > 0.0F)) {
            out.put(u, ceiling_);
            continue;
        }
        const float x = gx[u];
        const float y = gy[u];
        const float r = radius[u];
        std::uint32_t near;
        if (r < fine_reach)
            near = fine.near[static_cast<std::size_t>(cell[u])];
        else if (r < coarse_reach)
            near = coarse_.near[static_cast<std::size_t>(coarse_.grid.cell(x, y))];
        else
            near = std::abs(x) > carpet_x + r || std::abs(y) > carpet_y + r ? outside_bit : every_part;
        if (near == outside_bit) {
            out.put(u, floor_);
            continue;
        }
        if (near == 0) continue;
        const Footprint p = footprint(x, y, t);
        const std::uint32_t lines = near & ~(carpet_edge_bit | outside_bit);
        if (lines != 0) out.blend(u, line_, line_share(lines, p));
        if ((near & carpet_edge_bit) != 0) out.blend(u, floor_, 1.0F - carpet_share(p));
    }
    if (!shadows_.empty()) cast_shadows(out);
}

void GroundPainter::cast_shadows(const LightRow& out) {
    shadows_.find_cells(x_.data(), y_.data(), out.width, cell_.data());
    for (int u = 0; u < out.width; ++u) {
        const auto i = static_cast<std::size_t>(u);
        const int first = shadows_.first_in(cell_[i], x_[i], y_[i], radius_[i]);
        if (first < 0 || !(depth_[i] > 0.0F)) continue;
        const float lost = shadows_.share(first, footprint(x_[i], y_[i], depth_[i]));
        if (lost <= 0.0F) continue;
        const float left = 1.0F - lamps_share_ * lost;
        out.r[u] *= left;
        out.g[u] *= left;
        out.b[u] *= left;
    }
}

}  // namespace goalmouth
