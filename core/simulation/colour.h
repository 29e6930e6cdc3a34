#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace goalmouth {

/// Light of one pixel or surface, in display levels: 0 black … 255 white, before any clipping.
struct Rgb {
    float r = 0.0F;
    float g = 0.0F;
    float b = 0.0F;
};

inline Rgb operator*(float scale, const Rgb& c) {
    return {scale * c.r, scale * c.g, scale * c.b};
}

/// A colour as a parameter states it: three levels. Throws std::invalid_argument naming the parameter where
/// it is not three.
inline Rgb rgb_parameter(const char* name, const std::vector<double>& levels) {
    if (levels.size() != 3)
        throw std::invalid_argument(std::string(name) +
                                    ": a colour is three levels [red, green, blue] in 0…255");
    return {static_cast<float>(levels[0]), static_cast<float>(levels[1]), static_cast<float>(levels[2])};
}

}  // namespace goalmouth
