#pragma once

#include "core/imaging/yuyv.h"

#include <optional>
#include <vector>

namespace goalmouth {

/// A place in a row where a line might run.
struct LinePoint {
    int y = 0;
    double x = 0.0;  // px
};

/// A cylinder that rows show, if they show nothing else there.
struct SupposedCylinder {
    int outwards = 1;     // its edge on this side: 1 right, −1 left
    double inside = 0.0;  // px, from the line to that edge
    double width = 0.0;   // px
    double blur = 0.0;    // px, σ of the lens along the row
};

/// Whether the luma of rows shows a line at one place, where a cylinder would be shaded smoothly.
struct LumaLine {
    double chi2 = 0.0;   // how much less misfit with it: of two degrees of freedom where there is none
    double sigma = 0.0;  // levels, of a step's height: what cannot be told from none
};

/// The mean course of luma across the line, row by row on its own level, is fitted with a cylinder's shading
///     a + b·u + c·√(1 − u²) + d·u²,   u from −1 at one edge to 1 at the other,
/// (light from one side, from ahead, from everywhere), its edge where that is near, all blurred; and with a
/// step and a ridge at the line beside it. Nothing where too few pixels or rows tell the two apart.
std::optional<LumaLine> luma_line(YuyvView image, const std::vector<LinePoint>& points,
                                  const SupposedCylinder& cylinder);

}  // namespace goalmouth
