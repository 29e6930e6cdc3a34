#pragma once

#include "core/simulation/in_view.h"
#include "core/simulation/light.h"
#include "core/simulation/objects.h"
#include "core/simulation/ray_table.h"

#include <memory>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// All but the ground as one camera pose sees it, set up once and painted row by row; also as poses close by
/// see it, without a new set-up.
class View {
  public:
    void look(const Things& things, const Light& light, const RayTable& rays, const Eigen::Isometry3d& T_WC);
    const Eigen::Isometry3d& T_WC() const { return T_WC_; }

    /// As T_WC() sees it.
    void paint(int row, const RowRays& rays, const LightRow& out);
    /// As T_WC_row sees it, which moves nothing by more than a pixel. The rays are taken to where they would
    /// meet the same point of a plane in the thing: exactly for panels; for round things the plane holds
    /// the outline, and what is off is the movement's parallax within the thing.
    void paint(int row, const RowRays& rays, const Eigen::Isometry3d& T_WC_row, const LightRow& out);

    void clear() { seen_.clear(); }

  private:
    struct Seen {
        std::unique_ptr<SeenObject> object;
        Eigen::Vector3f plane;  // m: 1 / depth of the ray (x, y, 1) is m·(x, y, 1), of points of the plane
    };
    std::vector<Seen> seen_;  // from far to near
    std::vector<std::unique_ptr<SeenObject>> solid_;
    Eigen::Isometry3d T_WC_ = Eigen::Isometry3d::Identity();
    std::vector<float> x_, y_;  // the row's rays in the frame of T_WC_
};

}  // namespace goalmouth
