#pragma once

#include "core/imaging/colour_labels.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"

#include <span>
#include <vector>

namespace goalmouth {

/// What stands in each picture like a goalpost in the table's goal colour: the paper's chain (scan-lines,
/// border, candidates, RANSAC) under strict rules. Only posts that rise above the field's border count, and
/// of those that the picture's left or right border cuts none, unless they are asked for: then what is seen
/// of them. Posts whose distance by width would be odd count too, for nobody said which camera it was.
std::vector<std::vector<PostOutline>> standing_posts(std::span<const YuyvImage> pictures,
                                                     const ColourTable& table, bool cut_ones = false);

}  // namespace goalmouth
