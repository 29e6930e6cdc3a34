#pragma once

#include "core/imaging/colour_labels.h"
#include "core/imaging/colour_regions.h"
#include "core/imaging/yuyv.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

/// What the rules say goals are painted in.
enum class GoalPaint { yellow, white };
/// "yellow", "white": Field::goal_colour. Throws std::invalid_argument for another.
GoalPaint goal_paint(const std::string& name);

/// The goals' colour as found, and where.
struct SalientGoal {
    std::vector<std::vector<PostOutline>> posts;  // by picture
    double area = 0.0;      // px in the outlines that have the colour, as a share of all pictures' pixels
    double filled = 0.0;    // share of the outlines that has it
    double salience = 0.0;  // share of the pixels of this colour that lies in posts
    double score() const { return area * filled * salience; }
};

/// The colour in which things stand on the field as goalposts do: slices of colour space are tried one by one
/// as if each were the goal's (yellow: hues that are nearer to yellow than to red or green once the lines'
/// colour, where it is known, is taken for white, at three saturations; white: the lines' hue and saturation,
/// at three brightnesses) and looked at through standing_posts(). The one wins whose pixels fill most post
/// area, fill it best, and are rarest elsewhere. Nothing where none shows a post. White needs the lines'
/// colour.
std::optional<SalientGoal> find_goal(std::span<const YuyvImage> pictures, const ChromaRegion& field,
                                     const std::optional<ChromaRegion>& line, GoalPaint paint);

}  // namespace goalmouth
