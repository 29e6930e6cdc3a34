#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/piece_evidence.h"

#include <array>
#include <vector>

namespace goalmouth {

/// Decides which rows of both edges speak of one and the same post, where they disagree.
///
/// What upsets a row (something that peeps out from behind the post, or hides its edge) upsets its neighbours
/// with the same background alike, however many they are; rows before different backgrounds that agree on a
/// place hardly do so by chance. So rows are put together to runs with one background, and a run's evidence
/// for a place a hardly grows with its length: with errors either small (σ) or anywhere within a few px, one
/// run tells
///     ln(1 + R / (√(2π) σ_run)),   σ_run² = σ²/n + τ²,
/// as far as its rows lie there. The places of both edges and a common turn about the line of sight are those
/// with most evidence.
class EdgeConsensus {
  public:
    struct Result {
        std::array<double, 2> evidence{};  // of each side's place
        std::array<double, 2> rival{};     // of the best place apart from it
        bool disagree = false;             // rows that are clean in themselves do not fit the best places
    };

    /// Rows as measured last (offset, information, clean). Weights become 0 or 1 where rows disagree.
    /// `roll` [rad]: of the fit so far against the measured vertical, whose sigma is `sigma`.
    Result find(std::array<EdgeRows, 2>& rows, double roll, double sigma);

  private:
    struct Piece {  // of a run: a few neighbouring rows
        double place = 0.0, turn = 0.0, variance = 0.0, rows = 0.0;
        double share = 0.0;       // of its run's evidence
        double per_square = 0.0;  // one over the square of how far it speaks of a place
        std::size_t first = 0, last = 0;
    };
    void split(const EdgeRows& rows, std::vector<Piece>& pieces);
    static double evidence(const std::vector<Piece>& pieces, double place, double turn);

    std::array<std::vector<Piece>, 2> pieces_;
    std::array<EdgePieceColumns, 2> columns_;
    std::array<RowColumn<float>, 2> evidence_;
    // Of a side:
    std::vector<std::size_t> counting_;  // rows
    std::vector<double> changes_;        // of the background, from each one's forerunner to it
    std::vector<float> changes_of_neighbours_;
};

}  // namespace goalmouth
