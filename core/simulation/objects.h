#pragma once

#include "core/simulation/coverage.h"
#include "core/simulation/light.h"
#include "core/simulation/ray_table.h"
#include "core/simulation/scene.h"

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// Rows and columns an object can touch, both ends included; empty where first > last.
struct PixelBox {
    int left = 0, top = 0, right = -1, bottom = -1;
    bool empty() const { return left > right || top > bottom; }
};

/// Pixels that a convex body with these corners (frame C) can touch. A body that reaches behind the camera
/// may touch any.
PixelBox box_of(std::span<const Eigen::Vector3d> corners, const Intrinsics& camera);

/// Plane through the camera centre with its normal n in frame C, scaled so that n·(x, y, 1) is in pixels;
/// which share of a pixel is on its positive side.
struct EdgePlane {
    explicit EdgePlane(const Eigen::Vector3d& normal, const Intrinsics& camera);
    float distance(float x, float y) const { return nx * x + ny * y + nz; }
    float nx, ny, nz;
    EdgeCoverage coverage;
};

/// All within `radius` of a segment, frame C [m].
struct SeenBody {
    Eigen::Vector3d from, to;
    double radius;
};

/// A thing seen by one camera pose: knows its outline as edges through the camera centre, hence without any
/// approximation of where a pixel's square is cut, and paints itself over what lies behind it row by row.
class SeenObject {
  public:
    SeenObject(const PixelBox& box, const SeenBody& body);
    virtual ~SeenObject() = default;

    const PixelBox& box() const { return box_; }
    /// Holds all of it, a panel excepted.
    const SeenBody& body() const { return body_; }
    /// From the camera to the nearest point of the body's axis [m].
    double distance() const { return distance_; }

    /// First and last; none where first > last.
    struct Columns {
        int first, last;
    };
    /// Those of a row of its box that it can touch. Where rays are evenly spaced, only those of the box's
    /// first and last column are read.
    virtual Columns columns(const RowRays& rays) const = 0;
    /// Those that it covers fully, at least where it is large; only the same rays are read.
    virtual Columns filled(const RowRays&) const { return {0, -1}; }
    /// A row of the box; only the rays of its `columns` are read.
    virtual void paint(const RowRays& rays, Columns columns, const LightRow& out) = 0;

  protected:
    /// Columns of a row within 1.5 px of the positive side of all `edges`, within the box; where edges are
    /// curves in the image, the whole box.
    Columns columns_inside(std::span<const EdgePlane> edges, const RowRays& rays) const;
    /// Of the box's columns, those more than −`margin` px on the positive side of all `edges`, and up to one
    /// more on either side; evenly spaced rays.
    Columns columns_between(std::span<const EdgePlane> edges, const RowRays& rays, float margin) const;

  private:
    PixelBox box_;
    SeenBody body_;
    double distance_;
};

/// Nothing (null) where no pixel shows the thing.
std::unique_ptr<SeenObject> see(const Panel& panel, const Light& light, const RayTable& rays,
                                const Eigen::Isometry3d& T_WC);
std::unique_ptr<SeenObject> see(const Tube& tube, const Light& light, const RayTable& rays,
                                const Eigen::Isometry3d& T_WC);
std::unique_ptr<SeenObject> see(const Ball& ball, const Light& light, const RayTable& rays,
                                const Eigen::Isometry3d& T_WC);

}  // namespace goalmouth
