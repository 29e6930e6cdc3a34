#pragma once

#include "core/edges/camera_over_ground.h"
#include "core/edges/edge_parameters.h"
#include "core/edges/field_colour.h"
#include "core/edges/frame_edges.h"
#include "core/edges/ground.h"
#include "core/edges/upright_strip.h"

#include <optional>
#include <string>

namespace goalmouth {

/// Why a strip is no post; nothing where it may be one. For people and tests: the rules are parameters.
///
///   * enough of it shows both edges, and its surroundings look more unlike it than noise does;
///   * its edges are parallel, and it is as long for its width as a post is, which may be short only where
///     the picture cuts its top;
///   * it is no darker than the field: posts are yellow or white;
///   * it stands on the field: its foot is not above the border;
///   * it rises above the border, which no line on the field does. Where the picture shows no border above
///     it, it has to come from beyond the picture's top;
///   * where the camera's pose is known, it is as wide and as high as a post is at the distance at which its
///     foot meets the ground.
std::optional<std::string> why_no_post(const UprightStrip& strip, const FrameEdges& frame,
                                       const Ground& ground, const FieldColour& field,
                                       const StripParameters& parameters, const EdgeThreshold& threshold,
                                       double straightness, int picture_width, int picture_height,
                                       const CameraOverGround* view);

}  // namespace goalmouth
