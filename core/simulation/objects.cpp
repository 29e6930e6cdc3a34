#include "core/simulation/objects.h"

#include "core/simulation/vectorised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace goalmouth {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double margin = 2.0;  // px around a projected outline: the pixels its edge may still cross

/// Pixels that a convex body with these corners (frame C) can touch. A body that reaches behind the camera
/// may touch any.
PixelBox box_of(std::span<const Vector3d> corners, const Intrinsics& camera) {
    const PixelBox all{0, 0, camera.width - 1, camera.height - 1};
    double left = std::numeric_limits<double>::infinity(), top = left, right = -left, bottom = -left;
    bool behind = true;
    bool near = false;
    for (const Vector3d& p : corners) {
        if (p.z() > 0.0) behind = false;
        // Far outside the image a lens's distortion polynomial turns back, so a corner there proves nothing.
        const double reach = std::hypot(p.x(), p.y());
        if (p.z() < 0.05 || (camera.has_distortion() && reach > 1.2 * p.z())) {
            near = true;
            continue;
        }
        const Eigen::Vector2d pixel = *project(camera, p);
        left = std::min(left, pixel.x());
        right = std::max(right, pixel.x());
        top = std::min(top, pixel.y());
        bottom = std::max(bottom, pixel.y());
    }
    if (behind) return {};
    if (near) return all;
    // A straight edge between two corners bends under distortion: by less than this share of the box.
    const double bend = camera.has_distortion() ? 0.1 : 0.0;
    const double bend_x = margin + bend * (right - left);
    const double bend_y = margin + bend * (bottom - top);
    const auto clamped = [](double value, int size) {
        return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(size)));
    };
    return {std::max(0, clamped(std::floor(left - bend_x), camera.width)),
            std::max(0, clamped(std::floor(top - bend_y), camera.height)),
            std::min(camera.width - 1, clamped(std::ceil(right + bend_x), camera.width)),
            std::min(camera.height - 1, clamped(std::ceil(bottom + bend_y), camera.height))};
}

class SeenPanel : public SeenObject {
  public:
    SeenPanel(const PixelBox& box, const Vector3d& middle, const std::array<EdgePlane, 4>& edges, Rgb colour)
        : SeenObject(box, {middle, middle, 0.0}),
          edges_(edges),
          colour_(colour),
          inside_(static_cast<std::size_t>(box.right + 1)) {}

    Columns columns(const RowRays& rays) const override { return columns_inside(edges_, rays); }

    Columns filled(const RowRays& rays) const override {
        return rays.straight ? columns_between(edges_, rays, -2.0F) : Columns{0, -1};
    }

    void paint(const RowRays& rays, Columns columns, const LightRow& out) override {
        Columns full = filled(rays);
        if (full.first > full.last) {
            paint_cut(rays, columns, out);
            return;
        }
        paint_cut(rays, {columns.first, full.first - 1}, out);
        std::fill(out.r + full.first, out.r + full.last + 1, colour_.r);
        std::fill(out.g + full.first, out.g + full.last + 1, colour_.g);
        std::fill(out.b + full.first, out.b + full.last + 1, colour_.b);
        paint_cut(rays, {full.last + 1, columns.last}, out);
    }

  private:
    void paint_cut(const RowRays& rays, Columns columns, const LightRow& out) {
        const float* x = rays.x;
        const float* y = rays.y;
        const EdgePlane e0 = edges_[0], e1 = edges_[1], e2 = edges_[2], e3 = edges_[3];
        float* inside = inside_.data();
        for (int u = columns.first; u <= columns.last; ++u) {
            const float a = std::min(e0.distance(x[u], y[u]), e1.distance(x[u], y[u]));
            const float b = std::min(e2.distance(x[u], y[u]), e3.distance(x[u], y[u]));
            inside[u] = std::min(a, b);
        }
        for (int u = columns.first; u <= columns.last; ++u) {
            if (inside[u] >= 1.0F) {
                out.put(u, colour_);
            } else if (inside[u] > -1.0F) {
                const auto share = [&](const EdgePlane& e) { return e.coverage(e.distance(x[u], y[u])); };
                out.blend(u, colour_,
                          strip_coverage(share(e0), share(e2)) * strip_coverage(share(e1), share(e3)));
            }
        }
    }

    std::array<EdgePlane, 4> edges_;
    Rgb colour_;
    std::vector<float> inside_;  // px, of the row being painted
};

class SeenTube : public SeenObject {
  public:
    SeenTube(const PixelBox& box, const SeenBody& body, const CylinderSilhouette& outline, const Tube& tube,
             const Light& light, const Intrinsics& camera, const Eigen::Isometry3d& T_WC)
        : SeenObject(box, body),
          light_(light),
          sides_{EdgePlane(outline.left_plane, camera), EdgePlane(outline.right_plane, camera)},
          colour_(tube.colour),
          radius_(static_cast<float>(tube.cylinder.radius)),
          length_(static_cast<float>(tube.cylinder.length)),
          pixel_u_(static_cast<float>(1.0 / camera.fx)),
          pixel_v_(static_cast<float>(1.0 / camera.fy)) {
        const Eigen::Matrix3d R_CW = T_WC.linear().transpose();
        const Vector3d axis = R_CW * tube.cylinder.axis;
        const Vector3d base = R_CW * (tube.cylinder.base - T_WC.translation());
        axis_ = axis.cast<float>();
        lateral_ = base.cross(axis).cast<float>();
        const Vector3d ahead = base - base.dot(axis) * axis;
        ahead_ = ahead.cast<float>();
        camera_along_ = static_cast<float>(-base.dot(axis));
        const Vector3d lamps = R_CW * light.lamps();
        lamps_ = lamps.cast<float>();
        lamps_along_ = static_cast<float>(axis.dot(lamps));
        lamps_aside_ = lamps.cross(axis).cast<float>();
        // The end that shows its disc, if any: 0 none, −1 the base, +1 the top.
        shown_end_ = camera_along_ < 0.0F ? -1 : camera_along_ > length_ ? 1 : 0;
        const Vector3d end = shown_end_ > 0 ? Vector3d(base + tube.cylinder.length * axis) : base;
        end_ = end.cast<float>();
        end_light_ = static_cast<float>(light.flat(static_cast<double>(shown_end_) * tube.cylinder.axis));
    }

    Columns columns(const RowRays& rays) const override { return columns_inside(sides_, rays); }

    void paint(const RowRays& rays, Columns columns, const LightRow& out) override {
        for (int first = columns.first; first <= columns.last; first += most_at_once)
            paint_some(rays, first, std::min(most_at_once, columns.last - first + 1), out);
    }

  private:
    static constexpr int most_at_once = 128;

    struct Painted {
        float share = 0.0F;  // of the pixel
        float light = 0.0F;  // factor of the colour
    };

    /// `count` pixels from column `first` on.
    GOALMOUTH_VECTORISED void paint_some(const RowRays& rays, int first, int count,
                                         const LightRow& out) const {
        const float* x = rays.x + first;
        const float* y = rays.y + first;
        float share[most_at_once];
        float light[most_at_once];
        std::int32_t rest[most_at_once];  // 1: left to paint_cut()
        const EdgePlane left = sides_[0], right = sides_[1];
        const float lx = left.nx, ly = left.ny, lz = left.nz;
        const float rx = right.nx, ry = right.ny, rz = right.nz;
        const float ax = axis_.x(), ay = axis_.y(), az = axis_.z();
        const float ox = lateral_.x(), oy = lateral_.y(), oz = lateral_.z();
        const float fx = ahead_.x(), fy = ahead_.y(), fz = ahead_.z();
        const float mx = lamps_.x(), my = lamps_.y(), mz = lamps_.z();
        const float sx = lamps_aside_.x(), sy = lamps_aside_.y(), sz = lamps_aside_.z();
        const float along_lamps = lamps_along_;
        const float radius = radius_, per_radius = 1.0F / radius_, length = length_, base = camera_along_;
        const float pixel = pixel_u_ + pixel_v_;
        const float ambient = light_.ambient(), directional = light_.directional();
        const float limb = light_.limb_darkening();
        const EdgeCoverage left_cut = left.coverage, right_cut = right.coverage;
        int rests = 0;
        for (int i = 0; i < count; ++i) {
            const float dx = x[i];
            const float dy = y[i];
            const float l = lx * dx + ly * dy + lz;
            const float r = rx * dx + ry * dy + rz;
            const float between = left_cut.branchless(l) + right_cut.branchless(r) - 1.0F;
            const float along = ax * dx + ay * dy + az;
            const float across2 = dx * dx + dy * dy + 1.0F - along * along;
            const float per_across = 1.0F / std::sqrt(across2 > 1e-12F ? across2 : 1e-12F);
            const float ahead = (fx * dx + fy * dy + fz) * per_across;
            float sine = (ox * dx + oy * dy + oz) * per_across * per_radius;
            sine = sine < -1.0F ? -1.0F : sine;
            sine = sine > 1.0F ? 1.0F : sine;
            const float cosine = std::sqrt(1.0F - sine * sine);
            const float way = ahead - radius * cosine;
            const float slope = along * per_across;
            const float height = way * slope + base;
            const float reach = way * pixel * (1.0F + slope * slope) * per_across;
            const float from_end = std::min(height, length - height);
            const float ahead_lamps = (mx * dx + my * dy + mz - along * along_lamps) * per_across;
            const float aside_lamps = (sx * dx + sy * dy + sz) * per_across;
            const float facing = -cosine * ahead_lamps - sine * aside_lamps;
            light[i] =
                (ambient + directional * (facing > 0.0F ? facing : 0.0F)) * (1.0F - limb * (1.0F - cosine));
            const bool clear = (ahead > 0.0F) & (from_end >= reach);
            share[i] = (between > 0.0F) & clear ? between : 0.0F;
            const int left_over = !clear & (l > -1.0F) & (r > -1.0F) ? 1 : 0;
            rest[i] = left_over;
            rests += left_over;
        }
        if (rests > 0)
            for (int i = 0; i < count; ++i)
                if (rest[i] != 0) paint_cut(x[i], y[i], share[i], light[i]);
        float* __restrict red = out.r + first;
        float* __restrict green = out.g + first;
        float* __restrict blue = out.b + first;
        const Rgb colour = colour_;
        for (int i = 0; i < count; ++i) red[i] += share[i] * (light[i] * colour.r - red[i]);
        for (int i = 0; i < count; ++i) green[i] += share[i] * (light[i] * colour.g - green[i]);
        for (int i = 0; i < count; ++i) blue[i] += share[i] * (light[i] * colour.b - blue[i]);
    }

    /// A pixel that a side or an end cuts, or in which an end shows.
    void paint_cut(float x, float y, float& share, float& light) const {
        const Vector3f ray(x, y, 1.0F);
        const float l = sides_[0].distance(x, y);
        const float r = sides_[1].distance(x, y);
        const float between = strip_coverage(sides_[0].coverage(l), sides_[1].coverage(r));
        const Painted side = side_at(ray, between);
        bool rim_before_end = false;
        const Painted end = shown_end_ != 0 ? end_at(ray, rim_before_end) : Painted{};
        // Side and end take different parts of a pixel: neither lies over the other, and where they meet
        // they leave none of it.
        share = side.share + end.share;
        if (share <= 0.0F) {
            share = 0.0F;
            return;
        }
        light = (side.share * side.light + end.share * end.light) / share;
        if (rim_before_end && end.share > 0.0F) share = std::max(share, between);
        share = std::min(1.0F, share);
    }

    /// Where the ray meets the side, in the plane across the axis: written with the ray's offset from the
    /// axis, which is linear in the ray, because the textbook discriminant loses a thin far post to
    /// cancellation in single precision.
    Painted side_at(const Vector3f& d, float share) const {
        if (share <= 0.0F) return {};
        const float along = d.dot(axis_);
        const float across = std::sqrt(std::max(1e-12F, d.dot(d) - along * along));
        const float offset = lateral_.dot(d) / across;  // m, ray to axis, signed
        const float ahead =
            ahead_.dot(d) / across;  // m, along the ray's shadow to the axis; < 0: behind the camera
        if (ahead <= 0.0F) return {};
        const float sine = std::clamp(offset / radius_, -1.0F, 1.0F);
        const float cosine = std::sqrt(1.0F - sine * sine);
        const float way = ahead - radius_ * cosine;
        const float slope = along / across;
        const float height = way * slope + camera_along_;  // m, along the axis from the base
        // How far along the axis a pixel reaches, at most.
        const float reach = way * (pixel_u_ + pixel_v_) * (1.0F + slope * slope) / across;
        if (height < reach || length_ - height < reach) {
            const float gu =
                way * pixel_u_ * (axis_.x() - slope * (d.x() - along * axis_.x()) / across) / across;
            const float gv =
                way * pixel_v_ * (axis_.y() - slope * (d.y() - along * axis_.y()) / across) / across;
            const EdgeCoverage end(gu, gv);
            share *= strip_coverage(end(height), end(length_ - height));
            if (share <= 0.0F) return {};
        }
        // Unit vectors across the axis: along the ray's shadow, and square to it.
        const Vector3f shadow = (d - along * axis_) / across;
        const Vector3f square = axis_.cross(shadow);
        const Vector3f normal = -cosine * shadow - sine * square;
        return {share, light_.round(normal.dot(lamps_), cosine)};
    }

    /// `before`: the nearest point of its rim is on the camera's side of it.
    Painted end_at(const Vector3f& d, bool& before) const {
        const float along = d.dot(axis_);
        const float t = end_.dot(axis_) / along;
        if (!(t > 0.0F) || !std::isfinite(t)) return {};
        const Vector3f from_centre = t * d - end_;
        const float distance = std::max(1e-9F, from_centre.norm());
        const Vector3f outwards = from_centre / distance;
        const float turn = outwards.dot(d) / along;
        const EdgeCoverage edge(t * pixel_u_ * (outwards.x() - turn * axis_.x()),
                                t * pixel_v_ * (outwards.y() - turn * axis_.y()));
        before = outwards.dot(d) < 0.0F;
        return {edge(radius_ - distance), end_light_};
    }

    const Light& light_;
    std::array<EdgePlane, 2> sides_;
    Rgb colour_;
    float radius_, length_, pixel_u_, pixel_v_;
    Vector3f axis_, lateral_, ahead_, lamps_, end_;
    float lamps_along_;     // part of lamps_ along the axis
    Vector3f lamps_aside_;  // a ray's product with it: part of lamps_ square to the axis and the ray
    float camera_along_;    // m, camera centre along the axis from the base
    int shown_end_;
    float end_light_;
};

class SeenBall : public SeenObject {
  public:
    SeenBall(const PixelBox& box, const Vector3d& centre, const Ball& ball, const Light& light,
             const Intrinsics& camera, const Vector3d& lamps)
        : SeenObject(box, {centre, centre, ball.radius}),
          light_(light),
          colour_(ball.colour),
          towards_(centre.normalized().cast<float>()),
          distance_(static_cast<float>(centre.norm())),
          radius_(static_cast<float>(ball.radius)),
          angle_(static_cast<float>(std::asin(ball.radius / centre.norm()))),
          pixel_u_(static_cast<float>(1.0 / camera.fx)),
          pixel_v_(static_cast<float>(1.0 / camera.fy)),
          lamps_(lamps.cast<float>()) {}

    Columns columns(const RowRays&) const override { return {box().left, box().right}; }

    void paint(const RowRays& rays, Columns columns, const LightRow& out) override {
        const float* x = rays.x;
        const float* y = rays.y;
        for (int u = columns.first; u <= columns.last; ++u) {
            const Vector3f ray(x[u], y[u], 1.0F);
            const float length = ray.norm();
            const Vector3f d = ray / length;
            const float cosine = d.dot(towards_);
            if (cosine <= 0.0F) continue;
            const Vector3f off = d - cosine * towards_;
            const float sine = off.norm();
            const float angle = std::atan2(sine, cosine);
            if (angle > angle_ + 2.0F * (pixel_u_ + pixel_v_)) continue;
            // Direction in which the angle to the ball's centre grows, square to the ray.
            const Vector3f away =
                sine > 1e-7F ? Vector3f((off * cosine / sine - sine * towards_)) : Vector3f(1.0F, 0.0F, 0.0F);
            const EdgeCoverage edge(pixel_u_ * (away.x() - away.dot(d) * d.x()) / length,
                                    pixel_v_ * (away.y() - away.dot(d) * d.y()) / length);
            const float share = edge(angle_ - angle);
            if (share <= 0.0F) continue;
            const float offset = std::min(radius_, distance_ * sine);
            const float way = distance_ * cosine - std::sqrt(radius_ * radius_ - offset * offset);
            const Vector3f normal = ((way * d - distance_ * towards_) / radius_).normalized();
            out.blend(u, light_.round(normal.dot(lamps_), std::max(0.0F, -normal.dot(d))) * colour_, share);
        }
    }

  private:
    const Light& light_;
    Rgb colour_;
    Vector3f towards_;  // unit, to the centre
    float distance_, radius_, angle_, pixel_u_, pixel_v_;
    Vector3f lamps_;
};

/// From a point (the origin) to a segment.
double distance_to_segment(const Vector3d& a, const Vector3d& b) {
    const Vector3d run = b - a;
    const double length = run.squaredNorm();
    const double t = length > 0.0 ? std::clamp(-a.dot(run) / length, 0.0, 1.0) : 0.0;
    return (a + t * run).norm();
}

}  // namespace

SeenObject::SeenObject(const PixelBox& box, const SeenBody& body)
    : box_(box), body_(body), distance_(distance_to_segment(body.from, body.to)) {}

SeenObject::Columns SeenObject::columns_inside(std::span<const EdgePlane> edges, const RowRays& rays) const {
    if (!rays.straight || box_.left == box_.right) return {box_.left, box_.right};
    return columns_between(edges, rays, 1.5F);
}

SeenObject::Columns SeenObject::columns_between(std::span<const EdgePlane> edges, const RowRays& rays,
                                                float margin) const {
    const float* x = rays.x;
    const float* y = rays.y;
    const auto width = static_cast<float>(box_.right - box_.left);
    float first = 0.0F;
    float last = width;
    for (const EdgePlane& e : edges) {
        // The distance grows evenly along a row.
        const float start = e.distance(x[box_.left], y[box_.left]) + margin;
        const float end = e.distance(x[box_.right], y[box_.right]) + margin;
        if (start < 0.0F && end < 0.0F) return {0, -1};
        const float crossing = width * start / (start - end);
        if (start < 0.0F) first = std::max(first, crossing);
        if (end < 0.0F) last = std::min(last, crossing);
    }
    return {box_.left + static_cast<int>(std::floor(first)), box_.left + static_cast<int>(std::ceil(last))};
}

EdgePlane::EdgePlane(const Vector3d& normal, const Intrinsics& camera)
    : nx(0), ny(0), nz(0), coverage(0.0F, 0.0F) {
    const double gu = normal.x() / camera.fx;
    const double gv = normal.y() / camera.fy;
    const double scale = 1.0 / std::max(1e-12, std::sqrt(gu * gu + gv * gv));
    nx = static_cast<float>(scale * normal.x());
    ny = static_cast<float>(scale * normal.y());
    nz = static_cast<float>(scale * normal.z());
    coverage = EdgeCoverage(static_cast<float>(scale * gu), static_cast<float>(scale * gv));
}

std::unique_ptr<SeenObject> see(const Panel& panel, const Light& light, const RayTable& rays,
                                const Eigen::Isometry3d& T_WC) {
    const Eigen::Isometry3d T_CW = T_WC.inverse();
    std::array<Vector3d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = T_CW * panel.corners[i];
    const PixelBox box = box_of(corners, rays.camera());
    if (box.empty()) return nullptr;
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]);
    // Where the camera looks at the panel's back, the corners run the other way round.
    const double side = -normal.dot(corners[0]);
    if (std::abs(side) < 1e-12) return nullptr;
    const double turn = side < 0.0 ? 1.0 : -1.0;
    const auto edge = [&](std::size_t i) {
        return EdgePlane((turn * corners[i].cross(corners[(i + 1) % 4])).normalized(), rays.camera());
    };
    const Vector3d facing = (T_WC.linear() * normal).normalized() * (side > 0.0 ? 1.0 : -1.0);
    const Vector3d middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    return std::make_unique<SeenPanel>(box, middle,
                                       std::array<EdgePlane, 4>{edge(0), edge(1), edge(2), edge(3)},
                                       static_cast<float>(light.flat(facing)) * panel.colour);
}

std::unique_ptr<SeenObject> see(const Tube& tube, const Light& light, const RayTable& rays,
                                const Eigen::Isometry3d& T_WC) {
    const auto outline = silhouette(tube.cylinder, T_WC);
    if (!outline) return nullptr;
    const Eigen::Isometry3d T_CW = T_WC.inverse();
    const Vector3d base = T_CW * tube.cylinder.base;
    const Vector3d top = T_CW * tube.cylinder.top();
    // A box around the cylinder, square to its axis.
    const Vector3d axis = (top - base).normalized();
    const Vector3d one = axis.unitOrthogonal() * tube.cylinder.radius;
    const Vector3d other = axis.cross(one);
    const std::array<Vector3d, 8> corners = {base + one + other, base + one - other, base - one + other,
                                             base - one - other, top + one + other,  top + one - other,
                                             top - one + other,  top - one - other};
    const PixelBox box = box_of(corners, rays.camera());
    if (box.empty()) return nullptr;
    return std::make_unique<SeenTube>(box, SeenBody{base, top, tube.cylinder.radius}, *outline, tube, light,
                                      rays.camera(), T_WC);
}

std::unique_ptr<SeenObject> see(const Ball& ball, const Light& light, const RayTable& rays,
                                const Eigen::Isometry3d& T_WC) {
    const Vector3d centre = T_WC.inverse() * ball.centre;
    if (!(centre.norm() > ball.radius) || centre.z() <= -ball.radius) return nullptr;
    std::array<Vector3d, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = centre + ball.radius * Vector3d(i & 1U ? 1 : -1, i & 2U ? 1 : -1, i & 4U ? 1 : -1);
    const PixelBox box = box_of(corners, rays.camera());
    if (box.empty()) return nullptr;
    return std::make_unique<SeenBall>(box, centre, ball, light, rays.camera(),
                                      T_WC.linear().transpose() * light.lamps());
}

}  // namespace goalmouth
