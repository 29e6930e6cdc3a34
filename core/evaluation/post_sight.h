#pragma once

#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/bound.h"
#include "core/simulation/camera_motion.h"
#include "core/simulation/colour.h"
#include "core/simulation/image_formation.h"
#include "core/simulation/scene.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace goalmouth {

/// Contrast against noise from which on a piece of an edge can be seen.
inline constexpr double least_contrast_to_noise = 3.0;
/// Share of an edge that must be seen for the edge to count as seen.
inline constexpr double least_seen = 1.0 / 3.0;

/// What a frame shows of a post's two edges, and how well they can tell its distance.
struct PostSight {
    std::array<std::vector<EdgePiece>, 2> edges;  // left, right: what of it is in the picture and not hidden
    /// By edge: the length that is in the picture, not hidden and in contrast to what lies beside it
    /// (least_contrast_to_noise), as a share of that between the picture's first and last row.
    std::array<double, 2> seen{};
    std::optional<PostBound> bound;  // the vertical known; nothing where the edges do not tell the distance

    bool both_edges() const { return seen[0] >= least_seen && seen[1] >= least_seen; }
};

/// The same camera without noise, blur and processing, its rows read as quickly as they are but each in an
/// instant: every edge is where it was and as sharp as pixels are.
ImageFormationParameters undisturbed(ImageFormationParameters formation);

/// `clean` is the frame as `undisturbed(formation)` gives it. The edges lie where the renderer's geometry has
/// them; levels beside them are read from `clean` two and three pixels outside, so that a background that
/// changes along the edge counts as it is; the post's colour is the scene's, its brightness that of `clean`
/// next to the edge. Blur is the optics' and the movement's during the exposure. Sharpening, compression and
/// clipping are left out of the bound.
PostSight sight_of(const Scene& scene, std::size_t post, const Intrinsics& camera, const CameraMotion& motion,
                   const ImageFormationParameters& formation, const Rgb& gains, YuyvView clean);

}  // namespace goalmouth
