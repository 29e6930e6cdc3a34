#pragma once

#include "core/imaging/colour_table.h"
#include "core/imaging/known_colours.h"

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
///
/// What is known of the field's and the posts' colours decides where the table cannot: which of the two, or
/// neither, a colour is that clips, and whether what noise or another light brings near the posts' colour is
/// one. Likelihoods of SurfaceDensity, against those of grey things and of any others.
ColourTable adapted(const ColourTable& base, const ColourGains& gains, const KnownColours& known = {});

/// How much of what `base` calls goal `table`, which is adapted(base, gains, known), still does under the
/// gains, 0…1: of the posts' own colour, brighter and darker, where that is known, else of all alike. 1 where
/// `base` knows no goal. Where little is left, posts and something else have come to look the same.
double goals_kept(const ColourTable& base, const ColourTable& table, const ColourGains& gains,
                  const KnownColours& known);

}  // namespace goalmouth
