#include "core/simulation/objects.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace goalmouth {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

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

}  // namespace

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
