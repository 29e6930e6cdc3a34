#pragma once

#include "core/edges/edge_parameters.h"
#include "core/edges/frame_edges.h"
#include "core/edges/row_stretch.h"
#include "core/edges/strip_seeds.h"
#include "core/edges/upright_strip.h"
#include "core/imaging/yuyv.h"

namespace goalmouth {

/// Follows a seed's lines up and down as long as its surface lies between them, into stretches where an edge
/// is too faint to be found without knowing where to look: before a background like the post, in shadow, down
/// to its foot. On each row both edges are sought anew, each where the surface ends most clearly, and located
/// to a fraction of a pixel; the lines follow them.
///
/// Place of an edge: the colours beside it are taken as its sides a and b; each pixel between is projected on
/// b − a in (Y, Cb, Cr) as a share of "already b", and the edge is where a sharp step would have the same sum
/// of shares (core/segmentation/transition.h). Nothing where not one row shows an edge. `row`: memory to work
/// with.
UprightStrip grow_strip(YuyvView image, const FrameEdges& frame, const StripSeed& seed,
                        const StripParameters& parameters, const EdgeThreshold& threshold,
                        double straightness, RowStretch& row);

}  // namespace goalmouth
