#pragma once

#include "core/imaging/rgb.h"

namespace goalmouth {

/// Whether a pixel may show a surface of that colour: as dull or as bright as shadows, vignetting and mottle
/// make it, of the same chroma over luma but for noise.
inline bool same_surface(const LumaChroma& pixel, const LumaChroma& colour) {
    constexpr double brighter = 1.42;          // × or ÷
    constexpr double chroma_tolerance = 0.07;  // of luma
    constexpr double chroma_noise = 2.0;       // levels
    if (pixel.y < 1.0 || pixel.y > brighter * colour.y || brighter * pixel.y < colour.y) return false;
    const double scale = pixel.y / colour.y;
    const double cb = pixel.cb - scale * colour.cb, cr = pixel.cr - scale * colour.cr;
    const double allowed = chroma_tolerance * pixel.y + chroma_noise;
    return cb * cb + cr * cr <= allowed * allowed;
}

}  // namespace goalmouth
