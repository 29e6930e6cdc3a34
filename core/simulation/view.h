#pragma once

#include "core/simulation/in_view.h"
#include "core/simulation/light.h"
#include "core/simulation/objects.h"
#include "core/simulation/ray_table.h"

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// All but the ground as one camera pose sees it, set up once and painted row by row; also as poses close by
/// see it, without a new set-up.
class View {
  public:
    void look(const Things& things, const Light& light, const RayTable& rays, const Eigen::Isometry3d& T_WC);
    const Eigen::Isometry3d& T_WC() const { return T_WC_; }

    /// The next row to paint, as T_WC_row sees it, which moves nothing by more than a pixel; none: as T_WC()
    /// does. The rays are taken to where they would meet the same point of a plane in the thing: exactly for
    /// panels; for round things the plane holds the outline, and what is off is the movement's parallax
    /// within the thing.
    void begin_row(int row, const RowRays& rays, const Eigen::Isometry3d* T_WC_row);
    /// What of that row is not surely covered, from left to right: there the ground may show.
    std::span<const SeenObject::Columns> uncovered() const { return uncovered_; }
    void paint(const LightRow& out);

  private:
    struct Seen {
        std::unique_ptr<SeenObject> object;
        Eigen::Vector3f plane;  // m: 1 / depth of the ray (x, y, 1) is m·(x, y, 1), of points of the plane
    };
    struct Crossing {  // of a thing and the row
        const Seen* seen;
        SeenObject::Columns columns, filled;
        Eigen::Matrix3f turn;  // from the row's rays to those of T_WC_
    };

    void turn(const Eigen::Matrix3f& H, int first, int last);
    void find_uncovered();

    std::vector<Seen> seen_;  // from far to near
    std::vector<std::unique_ptr<SeenObject>> solid_;
    Eigen::Isometry3d T_WC_ = Eigen::Isometry3d::Identity();
    RowRays rays_{};
    bool turned_ = false;
    std::vector<Crossing> crossings_;  // of the row being painted, from far to near
    std::vector<SeenObject::Columns> filled_, uncovered_;
    std::vector<float> x_, y_;  // its rays in the frame of T_WC_
};

}  // namespace goalmouth
