#pragma once

#include "core/edges/edge_parameters.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

/// What counts as an edge in one frame.
struct EdgeThreshold {
    int window = 2;             // pairs on either side
    float chroma_weight = 2.F;  // of squared steps
    float strength = 8.F;       // grey levels
};

/// The largest window a row's sums have room for [pairs].
inline constexpr int widest_window = 32;

/// Parameters that are stated for a picture 640 px wide, in one of `width` px.
inline int window_pairs(const EdgeParameters& p, int width) {
    return std::clamp(static_cast<int>(std::lround(p.window * width / 1280.0)), 1, widest_window);
}
inline double straightness_px(const StripParameters& p, int width) {
    return p.straightness * std::max(1.0, width / 640.0);
}
inline double narrowest_px(const StripParameters& p, int width) {
    return p.narrowest * width / 640.0;
}

}  // namespace goalmouth
