#pragma once

#include "core/imaging/colour_regions.h"
#include "core/imaging/yuyv.h"

#include <optional>
#include <span>

// The colours of what lies on the ground, found in pictures nobody labelled: by where they are and how they
// occur.
namespace goalmouth {

/// The carpet's colour: the commonest green of the pictures' lower halves, in which each picture has one
/// vote, and the chroma around it up to where another surface's begins (ChromaHistogram::without_rivals).
/// Green is what has more green than red and than blue (hue 171…289°), by 6 levels of chroma or more; nothing
/// where not a twentieth of any picture's lower half is.
std::optional<ChromaRegion> find_field_colour(std::span<const YuyvImage> pictures);

/// The colour of the lines on a field of that colour: what is brighter than the carpet around it, long and
/// thin, and on the pitch. Nothing where there is no such thing.
std::optional<ChromaRegion> find_line_colour(std::span<const YuyvImage> pictures, const ChromaRegion& field);

/// The colour of the ball: of compact blobs with carpet all around that are neither carpet, nor line, nor in
/// the goal's colour, the hue that comes again in most pictures, two at least. A ball whose colour is
/// neutral, or that of the lines or the goal, has no colour of its own: nothing then.
std::optional<ChromaRegion> find_ball_colour(std::span<const YuyvImage> pictures, const ChromaRegion& field,
                                             const std::optional<ChromaRegion>& line,
                                             const ChromaRegion& goal);

}  // namespace goalmouth
