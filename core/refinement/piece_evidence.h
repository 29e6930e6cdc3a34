#pragma once

#include "core/refinement/edge_rows.h"

#include <cstddef>

namespace goalmouth {

/// Pieces of an edge (EdgeConsensus), a column for each quantity.
struct EdgePieceColumns {
    std::size_t count = 0;
    RowColumn<float> place, turn;  // px; px for each rad of roll
    RowColumn<float> per_square;   // one over the square of how far [px] a piece speaks of a place
    RowColumn<float> share;        // of its run's evidence

    void assign(std::size_t pieces);
};

/// With the edge turned by `turn`, how much evidence there is for the place that each piece has: of all
/// pieces s·(1 − miss²/reach²), where that is more than nothing. Returns the most.
float evidence_of_places(const EdgePieceColumns& pieces, float turn, RowColumn<float>& evidence);

}  // namespace goalmouth
