#pragma once

#include "core/geometry/camera.h"
#include "core/simulation/coverage.h"
#include "core/simulation/ground_grid.h"
#include "core/simulation/light.h"
#include "core/simulation/ray_table.h"
#include "core/simulation/scene.h"
#include "core/simulation/shadow.h"

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// Paints what lies in the plane z = 0: carpet, lines, floor, and the shadows on them. The share of each
/// pixel that a line covers is worked out from the line's edges and the pixel's footprint on the ground; a
/// map of which lines are near keeps that to pixels that need it.
class GroundPainter {
  public:
    GroundPainter(const Scene& scene, const Light& light, const Intrinsics& camera);

    /// Another hall with the same lines, carpet size and mottle: colours and shadows change.
    void change_scene(const Scene& scene, const Light& light);

    /// For the frame to come; the camera must be above the ground.
    void look(const Eigen::Isometry3d& T_WC);
    /// Pixels at or above the horizon become ceiling.
    void paint(const RowRays& rays, const LightRow& out);

  private:
    /// Which parts of the layout lie within `reach` of each square cell, as bits.
    struct Map {
        double reach = 0.0;
        GroundGrid grid;  // its rim is all outside
        std::vector<std::uint32_t> near;
    };
    struct FlatStroke {  // a stroke as its middle, direction and half sizes
        float x, y, dx, dy, half_length, half_width;
    };

    Map make_map(double cell, double reach) const;
    float stroke_share(const FlatStroke& stroke, const Footprint& p) const;
    float ring_share(const Ring& ring, const Footprint& p) const;
    float line_share(std::uint32_t near, const Footprint& p) const;
    float carpet_share(const Footprint& p) const;
    /// Of a pixel whose ray meets the ground in (x, y), `depth` along the optical axis.
    Footprint footprint(float x, float y, float depth) const;
    void cast_shadows(const LightRow& out);

    FieldLayout layout_;
    std::vector<FlatStroke> strokes_;
    float pixel_u_ = 0.0F, pixel_v_ = 0.0F;  // size of a pixel on the plane z = 1 of frame C
    Rgb carpet_, line_, floor_, ceiling_;
    Map fine_, coarse_;
    ShadowMap shadows_;
    float lamps_share_ = 0.0F;         // of the light on the ground
    std::vector<std::int8_t> mottle_;  // tile of the carpet's brightness
    float mottle_scale_ = 0.0F;        // share of brightness for each of its levels
    Eigen::Matrix3f R_WC_ = Eigen::Matrix3f::Identity();
    Eigen::Vector3f position_ = Eigen::Vector3f::Zero();
    std::vector<float> depth_, x_, y_, radius_, shade_;  // of the row being painted
    std::vector<int> cell_, spot_;  // likewise: where to look in the fine map and in the mottle
};

}  // namespace goalmouth
