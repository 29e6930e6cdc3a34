#pragma once

#include "core/detection/post.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/post_silhouette.h"

#include <optional>

namespace goalmouth::bench {

struct FullFit {
    PostSilhouette post;
    double distance = 0.0;  // m, from the camera to the post's axis, square to it
    double sigma = 0.0;     // m, of it
    double blur = 0.0;      // px
    int rows = 0;
    int values = 0;  // fitted
    int evaluations = 0;
};

/// Measures a post that a detector found as one would write it who wants all that the pixels tell and does
/// not count their cost: least squares over all pixels about both edges in every row, by MINPACK's
/// Levenberg–Marquardt as Eigen has it, with the derivatives worked out.
///
/// Unknown are the two planes that touch the post (a SilhouetteStep), the blur, and in each row the levels on
/// either side of each edge. The levels are linear and solved for in each evaluation (variable projection;
/// Golub and Pereyra, 1973; derivatives after Kaufman, 1975). An edge is the error function as pairs of
/// pixels gather it (StepProfile says the formula). A pair's colour (Y, Cb, Cr) is fitted as the two numbers
/// that are square to the post's own colour, which shading leaves alone. The measured vertical is one more
/// value, for the lean.
///
/// Nothing where an edge is missing, too short or too near to the other, or the fit does not end.
std::optional<FullFit> fit_all_pixels(YuyvView image, const Intrinsics& camera, const Post& start,
                                      double diameter, const std::optional<CameraPose>& pose);

}  // namespace goalmouth::bench
