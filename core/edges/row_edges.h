#pragma once

#include "core/edges/appearance.h"
#include "core/edges/chroma_row.h"
#include "core/edges/field_colour.h"
#include "core/edges/frame_scale.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace goalmouth {

/// Where the picture changes along a horizontal scan-line.
struct RowEdge {
    float x = 0.F;         // px, to about half a pixel
    float strength = 0.F;  // grey levels of the step
    Appearance left;       // what lies beside it
    Appearance right;
    bool left_is_field = false;
    bool right_is_field = false;
};

/// Appends the edges of a row, from left to right: local maxima of the step's size. Edges with the field on
/// both sides (its texture) are left out.
void find_row_edges(ChromaRow& row, const EdgeThreshold& threshold, const std::optional<FieldColour>& field,
                    std::vector<RowEdge>& edges);

}  // namespace goalmouth
