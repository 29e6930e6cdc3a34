#include "core/simulation/objects.h"
#include "core/simulation/vectorised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace goalmouth {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

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

}  // namespace

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

}  // namespace goalmouth
