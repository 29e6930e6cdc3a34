#include "core/simulation/objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace goalmouth {
namespace {

using Eigen::Vector3d;

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

}  // namespace

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

}  // namespace goalmouth
