#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/luma_line.h"

#include <vector>

namespace goalmouth {

/// Whether an edge comes down to a post's foot beside nothing but ground.
///
/// What stands before a post stands nearer, and its own foot is lower in the picture. So where, beside the
/// lowest rows of an edge, there is the ground that is below them as well, nothing stands before it.
/// `edge`: some of its rows, from the uppermost down. `width` [px]: of the post. Only ground that has a
/// colour tells.
bool ends_on_ground(YuyvView image, const std::vector<LinePoint>& edge, int outwards, double width,
                    double blur);

}  // namespace goalmouth
