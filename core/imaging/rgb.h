#pragma once

#include "core/imaging/colour.h"

namespace goalmouth {

/// Levels of red, green and blue, neither rounded nor held to what a byte holds.
struct Rgb {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
};

/// ITU-R BT.601, full range; `cb` and `cr` count from neutral.
inline Rgb rgb_of(double y, double cb, double cr) {
    return {y + 1.402 * cr, y - 0.344136 * cb - 0.714136 * cr, y + 1.772 * cb};
}
inline Rgb rgb_of(Ycbcr p) {
    return rgb_of(p.y, p.cb - 128.0, p.cr - 128.0);
}

/// The reverse: luma, and chroma from neutral.
struct LumaChroma {
    double y = 0.0;
    double cb = 0.0;
    double cr = 0.0;
};
inline LumaChroma luma_chroma_of(const Rgb& rgb) {
    const double y = 0.299 * rgb.red + 0.587 * rgb.green + 0.114 * rgb.blue;
    return {y, (rgb.blue - y) / 1.772, (rgb.red - y) / 1.402};
}

}  // namespace goalmouth
