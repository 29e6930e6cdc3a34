#pragma once

#include "core/imaging/colour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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
/// As bytes say it.
inline Ycbcr ycbcr_of(const LumaChroma& p) {
    const auto byte = [](double level) {
        return static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    };
    return {byte(p.y), byte(p.cb + 128.0), byte(p.cr + 128.0)};
}
inline Ycbcr ycbcr_of(const Rgb& rgb) {
    return ycbcr_of(luma_chroma_of(rgb));
}

/// Level from which on a channel counts as being at its end: mixing and rounding leave it below 255.
inline constexpr double clipped_level = 248.0;

/// Whether walls, floors and robots have a colour like that.
inline bool is_dull(const Rgb& rgb) {
    constexpr double least_chroma = 0.25;  // of luma
    const LumaChroma p = luma_chroma_of(rgb);
    return std::hypot(p.cb, p.cr) < least_chroma * p.y;
}

}  // namespace goalmouth
