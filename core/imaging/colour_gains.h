#pragma once

#include "core/imaging/colour_table.h"

namespace goalmouth {

/// How light and exposure have changed since a colour table was made: factors on the red, green and blue
/// levels of every surface (von Kries). A camera that codes light by a power law turns a change of light into
/// such factors, too.
struct ColourGains {
    double red = 1.0;
    double green = 1.0;
    double blue = 1.0;
    bool operator==(const ColourGains&) const = default;
};

/// Smallest and largest factor that means anything: with less a picture is black, with more it is white.
inline constexpr double least_gain = 0.05;
inline constexpr double largest_gain = 20.0;

/// The table that has for a surface's colour under these gains the class that `base` has for it without.
/// Where a channel clips, it is the class that most likely came to look like that (ClippedColours). A bit
/// finer than `base`, up to 7, where a channel became much darker. Gains of 1 give `base` itself.
ColourTable adapted(const ColourTable& base, const ColourGains& gains);

}  // namespace goalmouth
