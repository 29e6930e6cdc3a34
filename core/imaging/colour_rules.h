#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/colour_table.h"

#include <span>
#include <string>

namespace goalmouth {

/// Inclusive bounds.
struct Interval {
    double lowest = 0.0;
    double highest = 0.0;
    bool holds(double value) const { return value >= lowest && value <= highest; }
};

/// A colour seen as brightness and a vector in the chroma plane. Shading (less light on the same surface)
/// scales luma and chroma alike, so hue and saturation stay while luma and chroma fall.
struct ChromaPolar {
    double luma = 0.0;  // Y, 0…255
    double hue = 0.0;  // [deg] 0…360: direction of (Cb − 128, Cr − 128), from +Cb towards +Cr. Blue lies near
                       // 350, red near 110, orange 130, yellow 170, green 230; 0 for a neutral colour
    double chroma = 0.0;      // length of that vector, 0…181
    double saturation = 0.0;  // chroma / max(luma, 1)
};
ChromaPolar chroma_polar(Ycbcr colour);
/// The same of levels that are no whole numbers; chroma is from neutral.
ChromaPolar chroma_polar(double luma, double cb, double cr);

/// A box in colour space that belongs to one class. A bound left alone lets everything pass.
struct ColourRule {
    Colour colour = Colour::unclassified;
    Interval y{0, 255};
    Interval cb{0, 255};
    Interval cr{0, 255};
    Interval hue{0, 360};  // [deg]; lowest > highest runs through 0
    Interval chroma{0, 182};
    Interval saturation{0, 182};

    bool fits(Ycbcr p) const;
};

/// Each entry gets the class of the first rule that fits the colour in the middle of its cell.
ColourTable table_from_rules(std::span<const ColourRule> rules, int bits, const std::string& name);

}  // namespace goalmouth
