#pragma once

#include <algorithm>

namespace goalmouth {

/// Square cells that lie side by side over the ground, counted row by row.
struct GroundGrid {
    float inverse_cell = 1.0F;               // 1/m
    float origin_x = 0.0F, origin_y = 0.0F;  // m, corner of the first cell
    int width = 0, height = 0;               // cells

    /// Cell of a point; points beyond the grid fall into its rim.
    int cell(float x, float y) const {
        const float cx =
            std::min(std::max((x - origin_x) * inverse_cell, 0.0F), static_cast<float>(width - 1));
        const float cy =
            std::min(std::max((y - origin_y) * inverse_cell, 0.0F), static_cast<float>(height - 1));
        return static_cast<int>(cy) * width + static_cast<int>(cx);
    }
};

}  // namespace goalmouth
