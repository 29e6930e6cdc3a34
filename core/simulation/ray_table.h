#pragma once

#include "core/geometry/camera.h"
#include "core/simulation/colour.h"

#include <cstddef>
#include <vector>

namespace goalmouth {

/// The rays (x, y, 1) in frame C through the pixel centres of one row of the image.
struct RowRays {
    const float* x;
    const float* y;
    bool straight;  // (x, y) moves evenly along the row, so that straight edges cross it once
};

/// The ray (x, y, 1) in frame C through the centre of each pixel, distortion undone, worked out once for a
/// camera.
class RayTable {
  public:
    explicit RayTable(const Intrinsics& camera);

    const Intrinsics& camera() const { return camera_; }
    RowRays row(int y) const { return {x_.data() + offset(y), y_.data() + offset(y), straight_}; }

  private:
    std::size_t offset(int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width);
    }
    Intrinsics camera_;
    bool straight_;
    std::vector<float> x_;
    std::vector<float> y_;
};

/// A row of light while it is painted.
struct LightRow {
    float* r;
    float* g;
    float* b;
    int width;

    void put(int x, const Rgb& c) const {
        r[x] = c.r;
        g[x] = c.g;
        b[x] = c.b;
    }
    void blend(int x, const Rgb& c, float share) const {
        r[x] += share * (c.r - r[x]);
        g[x] += share * (c.g - g[x]);
        b[x] += share * (c.b - b[x]);
    }
};

}  // namespace goalmouth
